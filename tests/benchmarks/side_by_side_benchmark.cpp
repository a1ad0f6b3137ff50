// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
//
// What each fitter more costs: processor time and memory of a whole chain (source, segmentation and
// a number of fitters, a process each, at 10 Hz), and the straight line through them.
#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <idl/Lines.h>
#include <iostream>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "tests/benchmarks/process_usage.hpp"
#include "tests/integration/harness/deployment.hpp"

namespace {

using namespace quoin;
using namespace quoin::benchmarks;
using namespace std::chrono_literals;
using std::chrono::steady_clock;

/// What a chain took while it ran at 10 Hz.
struct Usage {
  int fitters = 0;
  double load = 0.0;      // [% of one processor] all processes
  double resident = 0.0;  // [MiB] all processes, shared pages counted in each
  double own = 0.0;       // [MiB] all processes, shared pages divided among those that share them
  std::uint64_t scans = 0;
  std::uint64_t lost = 0;  // sum over the fitters
};

std::string services(int fitters) {
  std::string text =
      "  - {name: front, kind: simulated, parameters: {rate_hz: 10}}\n"
      "  - {name: walls, kind: segmentation, input: front, method: iepf}\n";
  for (int i = 0; i < fitters; ++i) {
    text += "  - {name: fitter_" + std::to_string(i) +
            ", kind: line_fitting, input: walls, method: wctls}\n";
  }
  return text;
}

/// The processes of a deployment and readers of all its fitters.
class Chain {
 public:
  explicit Chain(int fitters)
      : deployment_(services(fitters)),
        participant_(deployment_.participant("benchmark")),
        status_(participant_, deployment_) {
    for (int i = 0; i < fitters; ++i) {
      const std::string name = "fitter_" + std::to_string(i);
      recorders_.push_back(
          std::make_unique<tests::Recorder<msg::Lines>>(participant_, deployment_, name));
      processes_.push_back(deployment_.start(name, 1));
    }
    for (const auto& recorder : recorders_) {
      if (!recorder->wait_for_writer()) throw std::runtime_error("a fitter did not start");
    }
    processes_.push_back(deployment_.start("walls"));
    processes_.push_back(deployment_.start("front"));
  }

  /// Takes messages until each fitter has `count`.
  [[nodiscard]] bool wait_for(std::size_t count, std::chrono::milliseconds timeout) {
    return tests::eventually(
        [&] {
          bool complete = true;
          for (auto& recorder : recorders_) complete = recorder->poll() >= count && complete;
          return complete;
        },
        timeout);
  }

  [[nodiscard]] std::chrono::duration<double> processor_time() const {
    std::chrono::nanoseconds sum{};
    for (const auto& process : processes_) sum += benchmarks::processor_time(process.pid());
    return sum;
  }

  void measure_memory(Usage& usage) const {
    for (const auto& process : processes_) {
      usage.resident += resident_mib(process.pid());
      usage.own += proportional_mib(process.pid());
    }
  }

  /// Ends the source and counts what came.
  void finish(Usage& usage) {
    processes_.back().signal(SIGTERM);
    if (!status_.wait_for("front", [](const auto& status) {
          return status.state() == msg::ServiceState::STATE_STOPPED;
        })) {
      throw std::runtime_error("the source does not end");
    }
    usage.scans = status_.latest("front").published();
    (void)wait_for(usage.scans, 5s);
    for (const auto& recorder : recorders_) {
      usage.lost += usage.scans - recorder->accounting().received();
    }
  }

 private:
  tests::TestDeployment deployment_;
  runtime::Participant participant_;
  tests::StatusRecorder status_;
  std::vector<std::unique_ptr<tests::Recorder<msg::Lines>>> recorders_;
  std::vector<tests::Process> processes_;  // the source is the last
};

Usage measure(int fitters, double seconds) {
  Chain chain(fitters);
  Usage usage{.fitters = fitters};
  const auto warm_up = std::size_t{20};
  if (!chain.wait_for(warm_up, 60s)) throw std::runtime_error("the chain does not run");
  const auto before = chain.processor_time();
  const auto begin = steady_clock::now();
  if (!chain.wait_for(warm_up + static_cast<std::size_t>(10.0 * seconds), 600s)) {
    throw std::runtime_error("the chain came to a halt");
  }
  usage.load = 100.0 * ((chain.processor_time() - before) / (steady_clock::now() - begin));
  chain.measure_memory(usage);
  chain.finish(usage);
  return usage;
}

/// Least-squares line through figures over the number of fitters.
struct Trend {
  double slope = 0.0;
  double intercept = 0.0;
  double r_squared = 0.0;  // share of the variance that the line explains
};

Trend trend(const std::vector<Usage>& usages, double Usage::*figure) {
  const auto count = static_cast<double>(usages.size());
  double mean_x = 0.0;
  double mean_y = 0.0;
  for (const Usage& usage : usages) {
    mean_x += usage.fitters / count;
    mean_y += usage.*figure / count;
  }
  double xx = 0.0;
  double xy = 0.0;
  double yy = 0.0;
  for (const Usage& usage : usages) {
    const double x = usage.fitters - mean_x;
    const double y = usage.*figure - mean_y;
    xx += x * x;
    xy += x * y;
    yy += y * y;
  }
  const double slope = xy / xx;
  return {slope, mean_y - slope * mean_x, xy * xy / (xx * yy)};
}

void print(const std::vector<Usage>& usages) {
  std::printf("fitters  processor [%%]  resident [MiB]  own share [MiB]  scans  lost\n");
  for (const Usage& usage : usages) {
    std::printf("%7d  %13.2f  %14.1f  %15.1f  %5llu  %4llu\n", usage.fitters, usage.load,
                usage.resident, usage.own, static_cast<unsigned long long>(usage.scans),
                static_cast<unsigned long long>(usage.lost));
  }
  const auto line = [&](const char* name, double Usage::*figure, const char* unit) {
    const Trend t = trend(usages, figure);
    std::printf("%s: %.3f %s for each fitter more, R^2 %.4f\n", name, t.slope, unit, t.r_squared);
  };
  line("processor", &Usage::load, "% of one");
  line("resident memory", &Usage::resident, "MiB");
  line("own share of memory", &Usage::own, "MiB");
}

nlohmann::ordered_json report(const std::vector<Usage>& usages) {
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  for (const Usage& usage : usages) {
    rows.push_back({{"fitters", usage.fitters},
                    {"load_percent", usage.load},
                    {"resident_mib", usage.resident},
                    {"own_mib", usage.own},
                    {"scans", usage.scans},
                    {"lost", usage.lost}});
  }
  const auto line = [&](double Usage::*figure) -> nlohmann::ordered_json {
    const Trend t = trend(usages, figure);
    return {{"slope", t.slope}, {"intercept", t.intercept}, {"r_squared", t.r_squared}};
  };
  return {{"chains", rows},
          {"load_percent", line(&Usage::load)},
          {"resident_mib", line(&Usage::resident)},
          {"own_mib", line(&Usage::own)}};
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Processor time and memory of each fitter more beside the others, at 10 Hz"};
  std::vector<int> fitters{1, 4, 8, 16};
  double seconds = 10.0;
  bool json = false;
  app.add_option("--fitters", fitters, "Numbers of fitters, two at least")
      ->delimiter(',')
      ->check(CLI::Range(1, 32))
      ->capture_default_str();
  app.add_option("--seconds", seconds, "How long to measure each number [s]")
      ->check(CLI::Range(1.0, 3600.0))
      ->capture_default_str();
  app.add_flag("--json", json, "As a JSON object");
  CLI11_PARSE(app, argc, argv);
  std::sort(fitters.begin(), fitters.end());
  if (fitters.front() == fitters.back()) {
    std::cerr << "--fitters: a line needs two different numbers\n";
    return 2;
  }
  try {
    std::vector<Usage> usages;
    for (const int count : fitters) {
      std::cerr << "side by side: " << count << " fitters for " << seconds << " s\n";
      usages.push_back(measure(count, seconds));
    }
    if (json) {
      std::cout << report(usages).dump(2) << '\n';
    } else {
      print(usages);
    }
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 1;
  }
  return 0;
}
