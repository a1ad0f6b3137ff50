// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
// The chain from a simulated sensor to corners without security, while a hostile neighbour speaks
// for its services every other second: what that costs honest scans in latency, and how many.

#include <chrono>
#include <idl/Corners.h>
#include <iostream>
#include <stdexcept>
#include <vector>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "services/runtime/node/clock.hpp"
#include "tests/benchmarks/figures.hpp"
#include "tests/integration/harness/deployment.hpp"
#include "tests/integration/harness/hostile_neighbour.hpp"

using namespace quoin;
using namespace quoin::benchmarks;
using namespace std::chrono_literals;
using std::chrono::steady_clock;

namespace {

nlohmann::ordered_json compare(std::chrono::seconds span, std::chrono::milliseconds pause) {
  const tests::TestDeployment deployment(R"(
  - {name: front, kind: simulated, parameters: {rate_hz: 10}}
  - {name: walls, kind: segmentation, input: front, method: iepf}
  - {name: wctls, kind: line_fitting, input: walls, method: wctls}
  - {name: corners, kind: corner_estimation, input: wctls, method: adjacent}
)");
  runtime::Participant participant(deployment.participant("attack_benchmark"));
  runtime::Reader<msg::Corners> reader(
      participant, deployment.topic("corners"),
      runtime::output_qos(deployment.deployment().service("corners"),
                          deployment.output("corners")));
  std::vector<tests::Process> processes;
  for (const auto& service : deployment.deployment().services) {
    processes.push_back(deployment.start(service.name, service.name == "corners" ? 1 : 0));
  }
  tests::HostileNeighbour neighbour(deployment, "front", "walls", "wctls", 1);
  runtime::ScanAccounting accounting;
  std::vector<double> quiet;  // latencies of honest scans [s]
  std::vector<double> attacked;
  runtime::WaitSet wait_set;
  wait_set.add(reader);
  msg::Corners corners;
  const auto begin = steady_clock::now();
  auto next_attack = begin;
  std::uint64_t attacks = 0;
  for (std::uint64_t received = 0; steady_clock::now() - begin < span;) {
    neighbour.listen();
    const bool on = (steady_clock::now() - begin) / 1s % 2 == 1;
    if (on && neighbour.informed() && steady_clock::now() >= next_attack) {
      neighbour.attack();
      ++attacks;
      next_attack = steady_clock::now() + pause;
    }
    while (reader.take(corners)) {
      const double latency =
          1e-9 * static_cast<double>(runtime::now_ns() - corners.header().trace()[0].published());
      accounting.receive(corners.header());
      if (++received > 20) (on ? attacked : quiet).push_back(latency);  // all have met by then
    }
    wait_set.wait(5ms);
  }
  if (quiet.empty() || attacked.empty()) throw std::runtime_error("too few corners came");
  nlohmann::ordered_json figures;
  figures["attacks"] = attacks;
  for (const auto& [name, count] : neighbour.counts()) figures["sent: " + name] = count;
  figures["quiet_p50_us"] = quantile(quiet, 0.5) * 1e6;
  figures["attacked_p50_us"] = quantile(attacked, 0.5) * 1e6;
  figures["attacked_p50_over_quiet"] = quantile(attacked, 0.5) / quantile(quiet, 0.5);
  figures["attacked_p99_over_quiet"] = quantile(attacked, 0.99) / quantile(quiet, 0.99);
  figures["lost"] = accounting.lost();
  return figures;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Latency of honest scans at 10 Hz beside a hostile neighbour over that without"};
  int seconds = 60;
  int pause = 100;
  bool json = false;
  app.add_option("--seconds", seconds, "For how long [s]")->check(CLI::Range(10, 36000));
  app.add_option("--pause", pause, "From one of each kind to the next [ms]")
      ->check(CLI::Range(1, 1000));
  app.add_flag("--json", json, "As a JSON object");
  CLI11_PARSE(app, argc, argv);
  try {
    print(compare(std::chrono::seconds(seconds), std::chrono::milliseconds(pause)), json);
  } catch (const std::exception& error) {
    std::cerr << "attack_benchmark: " << error.what() << '\n';
    return 1;
  }
  return 0;
}
