// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "deploy/diagnostics/network_checks.hpp"

#include <algorithm>
#include <cstdlib>
#include <map>
#include <set>

#include "deploy/observation/table.hpp"

namespace quoin::deploy {

namespace {

constexpr std::int64_t most_apart = 20'000'000;  // [ns], a fifth of a revolution at 10 Hz

std::string where(const HeardProcess& process) {
  return "process " + std::to_string(process.process) + " on " + process.host;
}

}  // namespace

Checks check_clocks(const std::vector<HeardProcess>& processes, const std::string& own_host) {
  // The least delayed heartbeat of a host shows most of its clock.
  std::map<std::string, std::int64_t> apart;
  for (const HeardProcess& process : processes) {
    if (process.heard == 0 || process.host == own_host) continue;
    const auto [entry, first] = apart.emplace(process.host, process.delay);
    if (!first) entry->second = std::min(entry->second, process.delay);
  }
  Checks checks;
  for (const auto& [host, delay] : apart) {
    const std::string milliseconds = fixed(static_cast<double>(std::llabs(delay)) * 1e-6, 1);
    if (std::llabs(delay) <= most_apart) {
      checks.push_back({"clocks", Verdict::good,
                        "heartbeats of " + host + " are " + milliseconds + " ms apart", ""});
      continue;
    }
    checks.push_back({"clocks", Verdict::doubtful,
                      "the clock of " + host + " is " + milliseconds + " ms " +
                          (delay > 0 ? "behind" : "ahead of") +
                          " this host's: latencies and the times of scans from different hosts "
                          "cannot be compared",
                      "synchronise them: run chrony (apt install chrony) on each host, or PTP "
                      "(linuxptp) where the network cards have it"});
  }
  return checks;
}

Checks check_doubles(const std::vector<HeardProcess>& processes) {
  std::map<std::string, std::vector<const HeardProcess*>> living;
  for (const HeardProcess& process : processes) {
    if (process.active && process.heard > 0) living[process.service].push_back(&process);
  }
  Checks checks;
  for (const auto& [service, same] : living) {
    if (same.size() < 2) continue;
    std::string list;
    for (const HeardProcess* process : same)
      list += (list.empty() ? "" : " and ") + where(*process);
    checks.push_back(
        {"deployments", Verdict::bad,
         service + " runs more than once: " + list + "; readers get the results of both",
         "stop one of the two, or give it another namespace or domain"});
  }
  if (checks.empty() && !living.empty()) {
    checks.push_back({"deployments", Verdict::good,
                      std::to_string(living.size()) + " services are at work, each once", ""});
  }
  return checks;
}

Checks check_strangers(const std::vector<HeardProcess>& processes,
                       const std::vector<std::string>& foreign_writers) {
  constexpr const char* advice =
      "find who else runs in this domain (quoin status without a file shows all namespaces), or "
      "turn security on: docs/operations/security.md";
  Checks checks;
  for (const std::string& text : foreign_writers) {
    checks.push_back({"strangers", Verdict::bad, text, advice});
  }
  for (const HeardProcess& process : processes) {
    for (const std::string& text : process.input_complaints) {
      checks.push_back({"strangers", Verdict::doubtful, process.service + ": " + text, advice});
    }
  }
  return checks;
}

Checks check_qos(const std::vector<HeardProcess>& processes,
                 const std::vector<std::string>& of_heartbeats) {
  // Both sides report a mismatch, in the same words.
  std::set<std::string> texts(of_heartbeats.begin(), of_heartbeats.end());
  for (const HeardProcess& process : processes) {
    texts.insert(process.incompatible_qos.begin(), process.incompatible_qos.end());
  }
  Checks checks;
  for (const std::string& text : texts) {
    // Of one type of two versions of Quoin, of which DDS knows the name alone.
    const bool version = text.find(" with the fields ") != std::string::npos;
    checks.push_back(
        {"QoS", Verdict::bad, text + ": nothing passes between them",
         version ? "run the same version of Quoin on all hosts (quoin status names them)"
                 : "give both sides the same QoS; the key qos of a service names its preset"});
  }
  return checks;
}

Checks check_line_scatter(const std::vector<HeardProcess>& processes) {
  Checks checks;
  for (const HeardProcess& process : processes) {
    if (!process.line_scatter) continue;
    const std::string text = complaint(*process.line_scatter);
    if (text.empty()) continue;
    checks.push_back({"sensor model", Verdict::doubtful, process.service + ": " + text,
                      std::string(scatter_advice)});
  }
  return checks;
}

Checks check_ros2(const Deployment& deployment, const ros2::Surroundings& surroundings) {
  if (!ros2::speaks_to_ros2(deployment)) return {};
  Checks checks;
  for (const ros2::Obstacle& each : ros2::obstacles(deployment, surroundings)) {
    checks.push_back({"ROS 2", Verdict::doubtful, each.text, each.advice});
  }
  if (checks.empty()) {
    checks.push_back({"ROS 2", Verdict::good,
                      "nothing here keeps the deployment and ROS 2 from discovering each other",
                      ""});
  }
  return checks;
}

}  // namespace quoin::deploy
