// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <chrono>
#include <filesystem>
#include <functional>
#include <idl/Control.h>
#include <iostream>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "deploy/command/commands.hpp"
#include "deploy/kinds/kinds.hpp"
#include "deploy/orchestration/checksum.hpp"
#include "deploy/orchestration/coordinated_apply.hpp"
#include "deploy/orchestration/host.hpp"
#include "deploy/orchestration/instruction.hpp"
#include "deploy/orchestration/requester.hpp"
#include "deploy/orchestration/signals.hpp"
#include "services/deployment/deployment.hpp"
#include "services/keys/key_files.hpp"
#include "services/runtime/dds/participant.hpp"

namespace quoin::deploy {
namespace {

using Clock = std::chrono::steady_clock;
using Json = nlohmann::ordered_json;

struct ApplyOptions {
  std::string file;
  std::string host;
  double wait = 10.0;  // [s]
  bool dry_run = false;
  bool json = false;
};

std::string to_text(const msg::ControlStep& step) {
  std::string text = step.action() + " " + step.service();
  if (!step.detail().empty()) text += ": " + step.detail();
  const bool numbered = step.action() == "swap" || step.action() == "replace";
  if (numbered && step.first_sequence_number() > 0) {
    text += "; from scan " + std::to_string(step.first_sequence_number()) + " on";
  }
  return text;
}

/// All hosts, or none, but for a host that failed when others had begun.
struct Outcome {
  bool accepted = true;
  bool rolled_back = false;
  bool answered = true;
  std::string detail;  // why not, a line for each host to blame
};

Outcome outcome_of(const std::vector<HostOutcome>& hosts) {
  Outcome outcome;
  for (const auto& [host, reply, answered] : hosts) {
    outcome.answered = outcome.answered && answered;
    outcome.accepted = outcome.accepted && reply.accepted();
    outcome.rolled_back = outcome.rolled_back || reply.rolled_back();
    if (reply.accepted() || reply.detail() == withdrawn) continue;
    outcome.detail += outcome.detail.empty() ? "" : "\n";
    outcome.detail += (host.empty() ? "" : host + ": ") + reply.detail();
  }
  if (!outcome.accepted && outcome.detail.empty()) outcome.detail = "interrupted";
  return outcome;
}

void print_json(const std::vector<HostOutcome>& hosts, const Outcome& outcome, bool dry_run) {
  Json steps = Json::array();
  for (const auto& [host, reply, answered] : hosts) {
    for (const msg::ControlStep& step : reply.steps()) {
      steps.push_back({{"host", host},
                       {"action", step.action()},
                       {"service", step.service()},
                       {"detail", step.detail()},
                       {"first_sequence_number", step.first_sequence_number()}});
    }
  }
  const Json object{{"accepted", outcome.accepted},
                    {"rolled_back", outcome.rolled_back},
                    {"detail", outcome.detail},
                    {"dry_run", dry_run},
                    {"steps", steps}};
  std::cout << object.dump(2, ' ', false, Json::error_handler_t::replace) << '\n';
}

void print(const std::vector<HostOutcome>& hosts, const Outcome& outcome, bool dry_run) {
  for (const HostOutcome& host : hosts) {
    if (!host.reply.accepted()) continue;
    for (const msg::ControlStep& step : host.reply.steps()) {
      std::cout << (host.host.empty() ? "" : host.host + ": ") << to_text(step) << '\n';
    }
  }
  if (outcome.accepted) return;
  const bool changed = !dry_run && std::any_of(hosts.begin(), hosts.end(), [](const auto& host) {
    return host.reply.accepted() || !host.answered;
  });
  std::cerr << (outcome.rolled_back ? "rolled back: " : "refused: ") << outcome.detail << '\n';
  if (!changed) std::cerr << "nothing was changed\n";
}

/// Throws std::runtime_error when one of the supervisors cannot be reached.
void reach(Requester& requester, const Deployment& deployment,
           const std::vector<std::string>& hosts, double wait,
           const std::function<bool()>& interrupted) {
  const auto deadline = Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                           std::chrono::duration<double>(wait));
  for (const std::string& host : hosts) {
    bool reached = false;
    while (!reached && Clock::now() < deadline) {
      if (interrupted()) throw std::runtime_error("interrupted; nothing was changed");
      reached = requester.reach(supervisor_name(host),
                                std::min(deadline, Clock::now() + std::chrono::milliseconds(300)));
    }
    if (reached) continue;
    throw std::runtime_error("no deployment with namespace '" + deployment.name_space +
                             "' is up in domain " + std::to_string(deployment.domain) +
                             (host.empty() ? "" : " on host " + host) +
                             "; neither can be changed while it runs. quoin up starts a "
                             "deployment" +
                             (hosts.size() > 1 ? ", --host NAME changes one host alone" : ""));
  }
}

int run(const ApplyOptions& options) {
  const std::filesystem::path file = std::filesystem::absolute(options.file);
  const std::string text = read_deployment(options.file);
  const Deployment deployment = parse_deployment(text, options.file);
  const std::vector<std::string> hosts = hosts_to_change(deployment, options.host);
  // One host goes on by itself, several have to be instructed. Made before DDS starts its threads.
  const auto signals = hosts.size() > 1 ? std::make_unique<Signals>() : nullptr;
  const std::function<bool()> interrupted = [&, came = false]() mutable {
    came = came || (signals && signals->take() > 0);
    return came;
  };
  require_keys(deployment, {std::string(operator_identity)});
  runtime::Participant participant(
      runtime::participant_config(deployment, "quoin_apply", operator_identity));
  DdsRequester requester(participant, deployment.name_space);
  reach(requester, deployment, hosts, options.wait, interrupted);
  msg::ControlRequest request;
  request.action(msg::ControlAction::CONTROL_APPLY);
  request.file(file.string());
  request.checksum(checksum(text));
  request.dry_run(options.dry_run);
  request.wait(options.wait);
  const auto outcomes = apply_on(hosts, deployment, requester, request, interrupted);
  const Outcome outcome = outcome_of(outcomes);
  (options.json ? print_json : print)(outcomes, outcome, options.dry_run);
  if (outcome.accepted) return exit_ok;
  return outcome.rolled_back || !outcome.answered ? exit_failure : exit_configuration;
}

}  // namespace

Command add_apply(CLI::App& app) {
  CLI::App* line = app.add_subcommand(
      "apply", "Change a running deployment to what a file describes, with the least change");
  const auto options = std::make_shared<ApplyOptions>();
  line->add_option("file", options->file, "Deployment file (YAML)")->required();
  line->add_option("--host", options->host,
                   "Change the share of this host alone; else all hosts change, or none");
  line->add_flag("--dry-run", options->dry_run, "Print the plan, change nothing");
  line->add_option("--wait", options->wait, "How long new processes may take to be ready [s]")
      ->capture_default_str()
      ->transform(a_time());
  line->add_flag("--json", options->json, "The outcome as a JSON object");
  return {line, [options] { return run(*options); }};
}

}  // namespace quoin::deploy
