// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include <chrono>
#include <filesystem>
#include <idl/Control.h>
#include <iostream>
#include <memory>
#include <optional>
#include <string>

#include <nlohmann/json.hpp>

#include "deploy/apply/checksum.hpp"
#include "deploy/deployment/deployment.hpp"
#include "deploy/keys/key_check.hpp"
#include "deploy/keys/key_files.hpp"
#include "deploy/quoin/commands.hpp"
#include "deploy/quoin/host.hpp"
#include "deploy/quoin/requester.hpp"
#include "services/runtime/participant.hpp"

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

Clock::duration duration(double seconds) {
  return std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
}

std::string to_text(const msg::ControlStep& step) {
  std::string text = step.action() + " " + step.service();
  if (!step.detail().empty()) text += ": " + step.detail();
  return text;
}

void print(const msg::ControlReply& reply, const ApplyOptions& options) {
  if (options.json) {
    Json steps = Json::array();
    for (const msg::ControlStep& step : reply.steps()) {
      steps.push_back({{"action", step.action()},
                       {"service", step.service()},
                       {"detail", step.detail()},
                       {"first_sequence_number", step.first_sequence_number()}});
    }
    const Json object{{"accepted", reply.accepted()},
                      {"rolled_back", reply.rolled_back()},
                      {"detail", reply.detail()},
                      {"dry_run", options.dry_run},
                      {"steps", steps}};
    std::cout << object.dump(2, ' ', false, Json::error_handler_t::replace) << '\n';
    return;
  }
  if (!reply.accepted()) {
    std::cerr << (reply.rolled_back() ? "rolled back: " : "refused: ") << reply.detail()
              << "\nnothing was changed\n";
    return;
  }
  for (const msg::ControlStep& step : reply.steps()) {
    std::cout << to_text(step);
    const bool numbered = step.action() == "swap" || step.action() == "replace";
    if (numbered && step.first_sequence_number() > 0) {
      std::cout << "; from scan " << step.first_sequence_number() << " on";
    }
    std::cout << '\n';
  }
}

/// The outcome, after the plan; nothing when it does not come in time.
std::optional<msg::ControlReply> ask(Requester& requester, msg::ControlRequest& request,
                                     double wait) {
  const std::uint64_t number = requester.send(request);
  auto reply = requester.wait(number, Clock::now() + duration(5.0));
  // Each replaced service may take some seconds on top of what was granted for the start.
  while (reply && reply->pending()) {
    const double services = static_cast<double>(reply->steps().size());
    reply = requester.wait(number, Clock::now() + duration(wait + 10.0 + 10.0 * services));
  }
  return reply;
}

int run(const ApplyOptions& options) {
  const std::filesystem::path file = std::filesystem::absolute(options.file);
  const std::string text = read_deployment(options.file);
  const Deployment deployment = parse_deployment(text, options.file);
  const std::string host = host_to_run(deployment, options.host);
  require_keys(deployment, {std::string(operator_identity)});
  runtime::Participant participant(
      runtime::participant_config(deployment, "quoin_apply", operator_identity));
  Requester requester(participant, deployment.name_space);
  const std::string supervisor = supervisor_name(host);
  if (!requester.reach(supervisor, Clock::now() + duration(options.wait))) {
    std::cerr << "no deployment with namespace '" << deployment.name_space << "' is up in domain "
              << deployment.domain << (host.empty() ? "" : " on host " + host)
              << "; neither can be changed while it runs. quoin up starts a deployment\n";
    return exit_failure;
  }
  msg::ControlRequest request;
  request.service(supervisor);
  request.action(msg::ControlAction::CONTROL_APPLY);
  request.file(file.string());
  request.checksum(checksum(text));
  request.dry_run(options.dry_run);
  request.wait(options.wait);
  const auto reply = ask(requester, request, options.wait);
  if (!reply) {
    std::cerr << "no answer from quoin up; its output tells what it is doing\n";
    return exit_failure;
  }
  print(*reply, options);
  if (reply->accepted()) return exit_ok;
  return reply->rolled_back() ? exit_failure : exit_configuration;
}

}  // namespace

Command add_apply(CLI::App& app) {
  CLI::App* line = app.add_subcommand(
      "apply", "Change a running deployment to what a file describes, with the least change");
  const auto options = std::make_shared<ApplyOptions>();
  line->add_option("file", options->file, "Deployment file (YAML)")->required();
  line->add_option(
      "--host", options->host,
      "Host whose share of the deployment to change; else that of this machine's name");
  line->add_flag("--dry-run", options->dry_run, "Print the plan, change nothing");
  line->add_option("--wait", options->wait, "How long new processes may take to be ready [s]")
      ->capture_default_str()
      ->check(more_than_zero());
  line->add_flag("--json", options->json, "The outcome as a JSON object");
  return {line, [options] { return run(*options); }};
}

}  // namespace quoin::deploy
