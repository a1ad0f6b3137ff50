// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
//
// What it costs to run the seven stages of side_by_side.yaml in one process, against one process
// each: memory and processor time at 10 Hz, latency from scan to corners, and the rate without
// loss. Both run at the same time, and get the same scans one after the other.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <idl/Corners.h>
#include <idl/Scan.h>
#include <iostream>
#include <memory>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "core/statistics/order_statistics.hpp"
#include "services/runtime/dds/endpoints.hpp"
#include "tests/benchmarks/process_usage.hpp"
#include "tests/benchmarks/room_scans.hpp"
#include "tests/integration/harness/deployment.hpp"

namespace {

using namespace quoin;
using namespace quoin::benchmarks;
using namespace std::chrono_literals;
using std::chrono::steady_clock;

const std::vector<std::string> fitters{"utls", "wtls", "wctls"};

std::string services(bool composed) {
  std::string text =
      "  - {name: front, kind: simulated}\n"
      "  - {name: walls, kind: segmentation, input: front, method: iepf}\n";
  std::string all = "walls";
  for (const std::string& fitter : fitters) {
    text += "  - {name: " + fitter + ", kind: line_fitting, input: walls, method: " + fitter +
            "}\n  - {name: " + fitter + "_corners, kind: corner_estimation, input: " + fitter +
            "}\n";
    all += ", " + fitter + ", " + fitter + "_corners";
  }
  return composed ? text + "processes: {stages: [" + all + "]}\n" : text;
}

/// The stages in one process or in seven; this process is the source and reads the corners.
class Chain {
 public:
  Chain(bool composed, bool lossless)
      : deployment_(services(composed), lossless ? "qos: lossless\n" : "", "quoin",
                    composed ? "_composed" : "_separate"),
        participant_(deployment_.participant("benchmark")),
        scans_(participant_, deployment_.topic("front"),
               lossless ? runtime::QosPreset::lossless : runtime::QosPreset::sensor),
        scans_to_send_(make_scans()) {
    for (const std::string& fitter : fitters) {
      recorders_.push_back(std::make_unique<runtime::Reader<msg::Corners>>(
          participant_, deployment_.topic(fitter + "_corners"),
          lossless ? runtime::QosPreset::lossless : runtime::QosPreset::feature));
      wait_set_.add(*recorders_.back());
    }
    if (composed) {
      std::vector<std::string> arguments{"--deployment", deployment_.file().string(), "--process",
                                         "stages"};
      for (const std::string& fitter : fitters) {
        arguments.insert(arguments.end(), {"--observers", fitter + "_corners=1"});
      }
      processes_.emplace_back("quoin-process", arguments, deployment_.directory().path());
    } else {
      for (const std::string& fitter : fitters) {
        processes_.push_back(deployment_.start(fitter + "_corners", 1));
        processes_.push_back(deployment_.start(fitter));
      }
      processes_.push_back(deployment_.start("walls"));
    }
    if (!scans_.wait_for_readers(1, 30s)) throw std::runtime_error("the stages did not start");
  }

  void send() {
    msg::Scan& scan = scans_to_send_[next_ % scans_to_send_.size()];
    number(scan, next_++);
    while (!scans_.write(scan)) {
    }
  }

  /// What has come since, with its latencies from scan to corners [s]; false after `timeout`.
  bool receive(std::vector<double>& latencies, std::chrono::milliseconds timeout) {
    bool any = take(latencies);
    if (!any) {
      wait_set_.wait(timeout);
      any = take(latencies);
    }
    return any;
  }

  [[nodiscard]] std::chrono::duration<double> processor_time() const {
    std::chrono::nanoseconds sum{};
    for (const auto& process : processes_) sum += benchmarks::processor_time(process.pid());
    return sum;
  }
  [[nodiscard]] double resident() const {
    double sum = 0.0;
    for (const auto& process : processes_) sum += resident_mib(process.pid());
    return sum;
  }

 private:
  bool take(std::vector<double>& latencies) {
    bool any = false;
    for (const auto& recorder : recorders_) {
      while (recorder->take(corners_)) {
        const auto& trace = corners_.header().trace();
        latencies.push_back(
            static_cast<double>(trace.back().published() - trace.front().published()) * 1e-9);
        any = true;
      }
    }
    return any;
  }

  tests::TestDeployment deployment_;
  runtime::Participant participant_;
  runtime::Writer<msg::Scan> scans_;
  std::vector<msg::Scan> scans_to_send_;
  std::vector<std::unique_ptr<runtime::Reader<msg::Corners>>> recorders_;
  runtime::WaitSet wait_set_;
  std::vector<tests::Process> processes_;
  msg::Corners corners_;
  std::uint64_t next_ = 0;
};

struct Figures {
  double load = 0.0;          // [% of one processor] at 10 Hz
  double resident = 0.0;      // [MiB]
  double p50 = 0.0;           // [s]
  double p99 = 0.0;           // [s]
  double rate = 0.0;          // [Hz] without loss
  std::uint64_t missing = 0;  // corners that did not come
};

/// Scans at 10 Hz, to one after the other.
void at_10_hz(const std::vector<Chain*>& chains, int scans, std::vector<Figures>& figures) {
  std::vector<std::vector<double>> latencies(chains.size());
  std::vector<std::chrono::duration<double>> before;
  for (const Chain* chain : chains) before.push_back(chain->processor_time());
  const auto begin = steady_clock::now();
  auto next = begin;
  for (int i = 0; i < scans; ++i) {
    for (std::size_t c = 0; c < chains.size(); ++c) {
      chains[c]->send();
      next += 100ms / chains.size();
      while (steady_clock::now() < next) {
        const auto left = std::chrono::ceil<std::chrono::milliseconds>(next - steady_clock::now());
        (void)chains[c]->receive(latencies[c], std::max(left, 0ms));
      }
    }
  }
  const std::chrono::duration<double> time = steady_clock::now() - begin;
  for (std::size_t c = 0; c < chains.size(); ++c) {
    figures[c].load = 100.0 * ((chains[c]->processor_time() - before[c]) / time);
    figures[c].resident = chains[c]->resident();
    figures[c].missing += fitters.size() * static_cast<std::size_t>(scans) - latencies[c].size();
    figures[c].p50 = quantile(latencies[c], 0.5);
    figures[c].p99 = quantile(latencies[c], 0.99);
  }
}

/// Scans as fast as the chain takes them.
void flood(Chain& chain, std::size_t scans, Figures& figures) {
  std::vector<double> latencies;
  const auto begin = steady_clock::now();
  std::thread sender([&] {
    for (std::size_t i = 0; i < scans; ++i) chain.send();
  });
  const std::size_t wanted = scans * fitters.size();
  while (latencies.size() < wanted && chain.receive(latencies, 5000ms)) {
  }
  sender.join();
  const std::chrono::duration<double> time = steady_clock::now() - begin;
  figures.rate = std::max(figures.rate, static_cast<double>(scans) / time.count());
  figures.missing += wanted - latencies.size();
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Seven stages in one process against one process each"};
  int seconds = 20;
  int rounds = 3;
  bool json = false;
  app.add_option("--seconds", seconds, "How long to run at 10 Hz [s]")
      ->check(CLI::Range(1, 3600))
      ->capture_default_str();
  app.add_option("--rounds", rounds, "How often to measure the rate; the best counts")
      ->check(CLI::Range(1, 100))
      ->capture_default_str();
  app.add_flag("--json", json, "As a JSON object");
  CLI11_PARSE(app, argc, argv);
  try {
    std::vector<Figures> figures(2);  // separate, composed
    {
      Chain separate(false, false);
      Chain composed(true, false);
      const std::vector<Chain*> chains{&separate, &composed};
      std::vector<Figures> warm_up(2);
      at_10_hz(chains, 20, warm_up);
      std::cerr << "composed: both at 10 Hz for " << seconds << " s\n";
      at_10_hz(chains, 10 * seconds, figures);
    }
    Chain separate(false, true);
    Chain composed(true, true);
    for (int round = 0; round < rounds; ++round) {
      std::cerr << "composed: without loss, round " << round + 1 << " of " << rounds << '\n';
      flood(separate, 2000, figures[0]);
      flood(composed, 2000, figures[1]);
    }
    const Figures& one_each = figures[0];
    const Figures& together = figures[1];
    const nlohmann::ordered_json report{
        {"resident_over_separate", together.resident / one_each.resident},
        {"processor_over_separate", together.load / one_each.load},
        {"p50_over_separate", together.p50 / one_each.p50},
        {"rate_over_separate", together.rate / one_each.rate},
        {"missing", one_each.missing + together.missing}};
    if (json) {
      std::cout << report.dump(2) << '\n';
    } else {
      std::printf("stages     processor [%%]  resident [MiB]  p50 [ms]  p99 [ms]  rate [Hz]\n");
      for (const Figures& row : figures) {
        std::printf("%-9s  %13.2f  %14.1f  %8.2f  %8.2f  %9.0f\n",
                    &row == &one_each ? "separate" : "composed", row.load, row.resident,
                    1e3 * row.p50, 1e3 * row.p99, row.rate);
      }
      std::cout << report.dump(2) << '\n';
    }
    return report["missing"] == 0 ? 0 : 1;
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 1;
  }
}
