// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
// The chain from a simulated sensor to corners without security, with signed and with encrypted
// messages, in turn: what that costs in latency and processor time once all have met.

#include <chrono>
#include <idl/Corners.h>
#include <iostream>
#include <map>
#include <stdexcept>
#include <vector>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "services/runtime/node/clock.hpp"
#include "tests/benchmarks/figures.hpp"
#include "tests/benchmarks/process_usage.hpp"
#include "tests/integration/harness/keys.hpp"

using namespace quoin;
using namespace quoin::benchmarks;
using namespace std::chrono_literals;
using std::chrono::steady_clock;

namespace {

struct Cost {
  std::vector<double> latencies;          // [s] from the publication of a scan to its corners
  std::chrono::nanoseconds processor{0};  // of all services
  std::chrono::nanoseconds time{0};
  std::uint64_t lost = 0;
};

std::chrono::nanoseconds total_time(const std::vector<tests::Process>& processes) {
  std::chrono::nanoseconds total{0};
  for (const tests::Process& process : processes) total += processor_time(process.pid());
  return total;
}

void measure(const std::string& head, std::chrono::seconds span, Cost& cost) {
  const tests::TestDeployment deployment(R"(
  - {name: front, kind: simulated, parameters: {rate_hz: 10}}
  - {name: walls, kind: segmentation, input: front, method: iepf}
  - {name: wctls, kind: line_fitting, input: walls, method: wctls}
  - {name: corners, kind: corner_estimation, input: wctls, method: adjacent}
)",
                                         head);
  if (deployment.deployment().security) tests::make_keys(deployment);
  runtime::Participant participant(deployment.participant(std::string(operator_identity)));
  runtime::Reader<msg::Corners> reader(
      participant, deployment.topic("corners"),
      runtime::output_qos(deployment.deployment().service("corners"),
                          deployment.output("corners")));
  runtime::WaitSet wait_set;
  wait_set.add(reader);
  std::vector<tests::Process> processes;
  for (const auto& service : deployment.deployment().services) {
    processes.push_back(deployment.start(service.name, service.name == "corners" ? 1 : 0));
  }
  runtime::ScanAccounting accounting;
  msg::Corners corners;
  const auto next = [&] {
    while (!reader.take(corners)) {
      if (!wait_set.wait(20s)) throw std::runtime_error("no corners for 20 s");
    }
    accounting.receive(corners.header());
    return 1e-9 *
           static_cast<double>(runtime::now_ns() - corners.header().trace().front().published());
  };
  for (int i = 0; i < 20; ++i) (void)next();  // all have met by then
  const auto begin = steady_clock::now();
  const auto processor = total_time(processes);
  while (steady_clock::now() - begin < span) cost.latencies.push_back(next());
  cost.processor += total_time(processes) - processor;
  cost.time += steady_clock::now() - begin;
  cost.lost += accounting.lost();
}

nlohmann::ordered_json compare(int rounds, std::chrono::seconds span) {
  const std::vector<std::pair<std::string, std::string>> modes{
      {"open", ""},
      {"signed", "security: {keys: keys, encrypt: false}\n"},
      {"encrypted", "security: {keys: keys}\n"}};
  std::map<std::string, Cost> costs;
  for (int round = 0; round < rounds; ++round) {
    for (const auto& [name, head] : modes) measure(head, span, costs[name]);
  }
  const auto p50 = [&](const std::string& name) { return quantile(costs[name].latencies, 0.5); };
  const auto share = [&](const std::string& name) {
    return static_cast<double>(costs[name].processor.count()) /
           static_cast<double>(costs[name].time.count());
  };
  nlohmann::ordered_json figures;
  for (const auto& [name, head] : modes) {
    figures[name + "_p50_us"] = p50(name) * 1e6;
    figures[name + "_p99_us"] = quantile(costs[name].latencies, 0.99) * 1e6;
    figures[name + "_processor_percent"] = 100.0 * share(name);
    figures[name + "_lost"] = costs[name].lost;
  }
  for (const std::string name : {"signed", "encrypted"}) {
    figures[name + "_p50_over_open"] = p50(name) / p50("open");
    figures[name + "_processor_over_open"] = share(name) / share("open");
  }
  return figures;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Latency and processor time of the chain at 10 Hz with security over without"};
  int rounds = 3;
  int seconds = 10;
  bool json = false;
  app.add_option("--rounds", rounds, "How often")->check(CLI::Range(1, 1000));
  app.add_option("--seconds", seconds, "For how long, each way [s]")->check(CLI::Range(1, 3600));
  app.add_flag("--json", json, "As a JSON object");
  CLI11_PARSE(app, argc, argv);
  try {
    print(compare(rounds, std::chrono::seconds(seconds)), json);
  } catch (const std::exception& error) {
    std::cerr << "security_benchmark: " << error.what() << '\n';
    return 1;
  }
  return 0;
}
