// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
// Kills the strong one of two segmentations again and again, and measures how long its reader waits
// for a result of the other one: to be compared with one and a half leases and a scan period.

#include <algorithm>
#include <chrono>
#include <csignal>
#include <idl/Segments.h>
#include <iostream>
#include <memory>
#include <optional>
#include <random>
#include <stdexcept>
#include <thread>
#include <vector>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "services/runtime/accounting/accounting.hpp"
#include "services/runtime/dds/endpoints.hpp"
#include "services/runtime/dds/participant.hpp"
#include "services/topics/header.hpp"
#include "tests/benchmarks/figures.hpp"
#include "tests/integration/harness/deployment.hpp"

using namespace quoin;
using namespace std::chrono_literals;
using std::chrono::steady_clock;

namespace {

constexpr auto lease = 100ms;
constexpr auto period = 100ms;

double milliseconds(steady_clock::duration time) {
  return std::chrono::duration<double, std::milli>(time).count();
}

/// The segments that a reader of the two instances hears.
class Listener {
 public:
  explicit Listener(const tests::TestDeployment& deployment)
      : participant_(deployment.participant("benchmark")),
        reader_(participant_, deployment.topic("walls"),
                runtime::output_qos(deployment.deployment().service("walls"),
                                    deployment.output("walls"))) {
    wait_set_.add(reader_);
  }

  /// The process that made the next result.
  std::uint64_t next() {
    while (true) {
      while (!reader_.take(message_)) {
        if (!wait_set_.wait(20s)) throw std::runtime_error("no segments for 20 s");
      }
      accounting_.receive(message_.header());
      if (accounting_.verdict() != runtime::ScanAccounting::Verdict::received) continue;
      return message_.header().trace().at(1).incarnation();
    }
  }

  [[nodiscard]] const runtime::ScanAccounting& accounting() const { return accounting_; }
  [[nodiscard]] std::uint64_t last_scan() const {
    return topics::sequence_number(message_.header());
  }

 private:
  runtime::Participant participant_;
  runtime::Reader<msg::Segments> reader_;
  runtime::WaitSet wait_set_;
  runtime::ScanAccounting accounting_;
  msg::Segments message_;
};

nlohmann::ordered_json measure(int kills) {
  const tests::TestDeployment deployment(R"(
  - {name: front, kind: simulated, parameters: {rate_hz: 10}}
  - {name: walls, kind: segmentation, input: front, strength: 2}
  - {name: walls, kind: segmentation, input: front, strength: 1}
)");
  Listener listener(deployment);
  const tests::Process weak = deployment.start("walls@1", 1);
  std::optional<tests::Process> front;
  auto strong = std::make_unique<tests::Process>(deployment.start("walls@2", 1));
  front.emplace(deployment.start("front"));
  std::uint64_t standby = 0;
  std::uint64_t owner = listener.next();
  std::mt19937 generator(1);
  std::uniform_int_distribution<int> phase(0, static_cast<int>(period.count()) - 1);
  std::vector<double> gaps;
  for (int i = 0; i < kills; ++i) {
    // The strong one is heard, and dies at any time between two scans.
    for (int scan = 0; scan < 3; ++scan) owner = listener.next();
    std::this_thread::sleep_for(std::chrono::milliseconds(phase(generator)));
    strong->signal(SIGKILL);
    const auto killed = steady_clock::now();
    std::uint64_t maker = owner;
    while (maker == owner) maker = listener.next();
    gaps.push_back(milliseconds(steady_clock::now() - killed));
    standby = maker;
    strong = std::make_unique<tests::Process>(deployment.start("walls@2"));
    while (listener.next() == standby) {
    }
  }
  std::sort(gaps.begin(), gaps.end());
  const double bound = 1.5 * milliseconds(lease) + milliseconds(period);
  const runtime::ScanAccounting& accounting = listener.accounting();
  return {{"standby_kills", kills},
          {"standby_gap_p50_ms", gaps[gaps.size() / 2]},
          {"standby_gap_worst_ms", gaps.back()},
          {"standby_bound_ms", bound},
          {"standby_p50_over_bound", gaps[gaps.size() / 2] / bound},
          {"standby_worst_over_bound", gaps.back() / bound},
          {"standby_scans_lost", accounting.lost()},
          {"standby_scans_heard", accounting.received()},
          {"standby_scans_unaccounted", listener.last_scan() + 1 - *accounting.first_sequence() -
                                            accounting.received() - accounting.lost()}};
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Time from the death of the strong instance to the first result of its standby"};
  int kills = 50;
  bool json = false;
  app.add_option("--kills", kills, "How often")->check(CLI::Range(1, 100000));
  app.add_flag("--json", json, "As a JSON object");
  CLI11_PARSE(app, argc, argv);
  try {
    benchmarks::print(measure(kills), json);
  } catch (const std::exception& error) {
    std::cerr << "standby_benchmark: " << error.what() << '\n';
    return 1;
  }
  return 0;
}
