// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
// A deployment under random kills, pauses, swaps, applies, visitors, nonsense and the messages of a
// hostile neighbour. Afterwards every scan must be accounted for, memory must not have grown, and
// nothing may be left behind.

#include <algorithm>
#include <csignal>
#include <ctime>
#include <iostream>
#include <random>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "services/deployment/graph.hpp"
#include "tests/integration/harness/leftovers.hpp"
#include "tests/soak/chaos.hpp"
#include "tests/soak/composition.hpp"
#include "tests/soak/memory.hpp"

using namespace quoin;
using namespace std::chrono_literals;
using nlohmann::ordered_json;
using std::chrono::steady_clock;

namespace {

// From this part of the run on nothing is killed that is spared, and its memory counts from the
// second: before, the pools of Fast DDS grow to the most participants that were ever there at once.
constexpr double last_kills = 0.3;
constexpr double begin_of_memory = 0.6;

/// Of the resident memory of those and quoin up together. In the first minutes the pools reach a
/// new height now and then.
double most_growth(double minutes) { return minutes < 10.0 ? 0.05 : 0.02; }

volatile std::sig_atomic_t interrupted = 0;

/// What a reader downstream sees of one corner service.
class Listener {
 public:
  Listener(runtime::Participant& participant, const tests::TestDeployment& deployment,
           const std::string& service)
      : service_(service),
        reader_(participant, deployment.topic(service), runtime::QosPreset::feature) {}

  void poll() {
    while (reader_.take(message_)) accounting_.receive(message_.header());
  }
  [[nodiscard]] const std::string& service() const { return service_; }
  [[nodiscard]] const runtime::ScanAccounting& accounting() const { return accounting_; }

 private:
  std::string service_;
  runtime::Reader<msg::Corners> reader_;
  runtime::ScanAccounting accounting_;
  msg::Corners message_;
};

/// What was found wrong, in words.
class Verdict {
 public:
  void require(bool condition, const std::string& what) {
    if (!condition) faults_.push_back(what);
  }
  [[nodiscard]] const std::vector<std::string>& faults() const { return faults_; }

 private:
  std::vector<std::string> faults_;
};

std::vector<std::filesystem::path> write_compositions(const tests::TestDeployment& deployment,
                                                      const soak::Scenario& scenario) {
  std::vector<std::filesystem::path> files;
  for (const std::string& services : scenario.compositions) {
    files.push_back(deployment.directory().write(
        "composition_" + std::to_string(files.size()) + ".yaml",
        "version: 1\nnamespace: " + deployment.deployment().name_space + "\ndomain: " +
            std::to_string(deployment.deployment().domain) + "\nservices:\n" + services));
  }
  return files;
}

/// Of the ends that all compositions have.
ordered_json judge_scans(const ordered_json& summary, const Deployment& deployment,
                         Verdict& verdict) {
  ordered_json result = ordered_json::object();
  const Graph graph(deployment);
  for (const Connection& end : graph.ends()) {
    const std::string& name = end.writer->name;
    const Connection source = graph.path_to(*end.writer, end.output).front();
    const auto published = summary.at("services")
                               .at(label(*source.writer))
                               .at("numbered")
                               .at(source.output.type)
                               .get<std::uint64_t>();
    const ordered_json& seen = summary.at("ends").at(name);
    const auto delivered = seen.at("scans_delivered").get<std::uint64_t>();
    const auto lost = seen.at("scans_lost").get<std::uint64_t>();
    result[name] = seen;
    result[name]["published"] = published;
    verdict.require(delivered > 0, name + " delivered nothing");
    verdict.require(delivered + lost == published,
                    name + ": " + std::to_string(delivered) + " scans delivered and " +
                        std::to_string(lost) + " lost, of " + std::to_string(published));
  }
  return result;
}

ordered_json judge_memory(const soak::Memory& memory, double minutes, Verdict& verdict) {
  double before = 0.0;
  double after = 0.0;
  ordered_json processes = ordered_json::array();
  for (const soak::Memory::Growth& growth : memory.growths()) {
    before += growth.before;
    after += growth.after;
    processes.push_back({{"service", growth.service},
                         {"mib_before", growth.before / 1048576.0},
                         {"mib_after", growth.after / 1048576.0}});
  }
  const double growth = before > 0.0 ? after / before - 1.0 : 0.0;
  verdict.require(growth <= most_growth(minutes),
                  "memory has grown by " + std::to_string(100.0 * growth) + " %");
  return {{"growth", growth}, {"processes", processes}};
}

ordered_json judge_leftovers(const tests::TestDeployment& deployment,
                             const std::set<std::string>& shared_memory_before, Verdict& verdict) {
  const auto processes = tests::processes_naming(deployment.directory().path().string());
  const auto ports = tests::bound_ports(deployment.deployment().domain);
  std::set<std::string> shared_memory;
  const auto now = tests::shared_memory_files();
  std::set_difference(now.begin(), now.end(), shared_memory_before.begin(),
                      shared_memory_before.end(),
                      std::inserter(shared_memory, shared_memory.end()));
  verdict.require(processes.empty(), std::to_string(processes.size()) + " processes are left");
  verdict.require(ports.empty(), std::to_string(ports.size()) + " UDP ports are left");
  verdict.require(shared_memory.empty(),
                  std::to_string(shared_memory.size()) + " shared-memory files are left");
  return {{"processes", processes}, {"ports", ports}, {"shared_memory", shared_memory}};
}

struct Options {
  double minutes = 3.0;
  std::uint64_t seed = 0;
  bool verbose = false;
  bool kinds = false;
  bool composed = false;
};

ordered_json run(const Options& options, Verdict& verdict) {
  const auto shared_memory = tests::shared_memory_files();
  soak::Scenario scenario = options.kinds      ? soak::test_kinds()
                            : options.composed ? soak::composed_stages()
                                               : soak::shipped_kinds();
  const tests::TestDeployment deployment(scenario.compositions.front(), "", scenario.tool);
  tests::Process up = deployment.quoin({"up", "FILE", "--json"});
  soak::Memory memory;
  ordered_json report{{"minutes", options.minutes}, {"seed", options.seed}};
  {
    runtime::Participant participant(deployment.participant("listener"));
    Listener first(participant, deployment, scenario.listened[0]);
    Listener second(participant, deployment, scenario.listened[1]);
    soak::Chaos chaos(deployment, scenario, write_compositions(deployment, scenario), options.seed);
    const auto begin = steady_clock::now();
    const auto end = begin + std::chrono::duration_cast<steady_clock::duration>(
                                 std::chrono::duration<double>(60.0 * options.minutes));
    const auto spare_from = begin + (end - begin) * last_kills;
    const auto memory_from = begin + (end - begin) * begin_of_memory;
    bool sparing = false;
    bool counting = false;
    auto next_line = begin + 10s;
    std::map<pid_t, std::string> watched{{up.pid(), "quoin up"}};
    while (steady_clock::now() < end && interrupted == 0 && !up.wait(0ms)) {
      first.poll();
      second.poll();
      chaos.step();
      const auto now = steady_clock::now();
      if (!sparing && now >= spare_from) {
        sparing = true;
        chaos.spare(scenario.spared);
      }
      if (!counting && now >= memory_from) {
        counting = true;
        memory.begin();
      }
      for (const auto& [process, service] : chaos.processes()) {
        if (scenario.spared.contains(service)) watched[process] = service;
      }
      memory.sample(watched);
      if (now >= next_line) {
        next_line += 10s;
        std::cerr << std::chrono::duration_cast<std::chrono::seconds>(now - begin).count()
                  << " s: " << first.accounting().received() << " scans delivered, "
                  << first.accounting().lost() << " lost;";
        for (const auto& [what, count] : chaos.counts())
          std::cerr << ' ' << count << ' ' << what << ',';
        std::cerr << '\n';
      }
      const timespec pause{0, 5'000'000};
      ::nanosleep(&pause, nullptr);
    }
    verdict.require(!up.wait(0ms), "quoin up ended by itself");
    chaos.end_disturbances();
    up.signal(SIGINT);
    report["exit_code"] = up.wait(60s).value_or(-1);
    verdict.require(report["exit_code"] == 0, "quoin up ended with another exit code than 0");
    report["done"] = chaos.counts();
    for (const Listener* listener : {&first, &second}) {
      report["listener"][listener->service()] = {{"received", listener->accounting().received()},
                                                 {"lost", listener->accounting().lost()},
                                                 {"repeated", listener->accounting().duplicates()}};
    }
  }
  const ordered_json summary = ordered_json::parse(up.output(), nullptr, false);
  verdict.require(summary.is_object(), "quoin up gave no summary");
  if (summary.is_object()) report["scans"] = judge_scans(summary, deployment.deployment(), verdict);
  report["memory"] = judge_memory(memory, options.minutes, verdict);
  report["log_bytes"] = up.errors().size();
  report["left"] = judge_leftovers(deployment, shared_memory, verdict);
  if (options.verbose || !verdict.faults().empty()) std::cerr << up.errors();
  return report;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Runs a deployment under random disturbances and judges what is left of it"};
  Options options;
  options.seed = std::random_device{}();
  app.add_option("--minutes", options.minutes, "How long")->capture_default_str();
  app.add_option("--seed", options.seed, "Of the schedule; random unless given, and printed");
  app.add_flag("--kinds", options.kinds, "With the kinds of tests/kinds, beside shipped ones");
  app.add_flag("--composed", options.composed,
               "With the stages of side_by_side.yaml in one process, or several");
  app.add_flag("--verbose", options.verbose, "Print the log of the deployment");
  CLI11_PARSE(app, argc, argv);
  std::signal(SIGINT, [](int) { interrupted = 1; });
  std::signal(SIGTERM, [](int) { interrupted = 1; });
  std::cerr << "soak: " << options.minutes << " minutes, seed " << options.seed << '\n';
  try {
    Verdict verdict;
    ordered_json report = run(options, verdict);
    report["faults"] = verdict.faults();
    std::cout << report.dump(2) << '\n';
    for (const std::string& fault : verdict.faults()) std::cerr << "soak: " << fault << '\n';
    return verdict.faults().empty() ? 0 : 1;
  } catch (const std::exception& error) {
    std::cerr << "soak: " << error.what() << '\n';
    return 1;
  }
}
