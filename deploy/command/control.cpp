// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include <chrono>
#include <idl/Control.h>
#include <iostream>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

#include "deploy/command/commands.hpp"
#include "deploy/command/network_options.hpp"
#include "deploy/orchestration/requester.hpp"
#include "services/deployment/deployment.hpp"
#include "services/keys/key_files.hpp"
#include "services/runtime/dds/participant.hpp"

namespace quoin::deploy {
namespace {

using Clock = std::chrono::steady_clock;

struct ControlOptions {
  std::string service;
  std::string method;
  std::vector<std::string> settings;  // name=value
  std::string file;
  NetworkOptions network;
  bool drop_state = false;
  double wait = 5.0;  // [s]
  bool json = false;
};

void add_settings(const std::vector<std::string>& settings, msg::ControlRequest& request) {
  for (const std::string& text : settings) {
    const std::size_t equals = text.find('=');
    msg::ParameterSetting& setting = request.parameters().emplace_back();
    setting.name(text.substr(0, equals));
    setting.value(text.substr(equals + 1));
  }
}

nlohmann::ordered_json to_json(const msg::ControlReply& reply) {
  auto parameters = nlohmann::ordered_json::object();
  for (const msg::ParameterSetting& setting : reply.parameters()) {
    parameters[setting.name()] = setting.value();
  }
  return {{"service", reply.service()}, {"accepted", reply.accepted()},
          {"detail", reply.detail()},   {"method", reply.method()},
          {"parameters", parameters},   {"first_sequence_number", reply.first_sequence_number()}};
}

void print(const msg::ControlReply& reply) {
  if (!reply.accepted()) {
    std::cerr << reply.service() << ": refused: " << reply.detail() << "; nothing was changed\n";
    return;
  }
  std::cout << reply.service() << ':' << (reply.method().empty() ? "" : " " + reply.method());
  for (const msg::ParameterSetting& setting : reply.parameters()) {
    std::cout << ' ' << setting.name() << '=' << setting.value();
  }
  if (!reply.method().empty()) {
    std::cout << " from scan " << reply.first_sequence_number() << " on";
  }
  std::cout << '\n';
}

int run(const ControlOptions& options, msg::ControlAction action) {
  const Deployment deployment = deployment_to_reach(options.network, options.file);
  // A name that is none is reported at once.
  if (!options.file.empty()) (void)deployment.service(options.service);
  runtime::Participant participant(
      runtime::participant_config(deployment, "quoin_control", operator_identity));
  DdsRequester requester(participant, deployment.name_space);
  const auto deadline = Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                           std::chrono::duration<double>(options.wait));
  if (!requester.reach(options.service, deadline)) {
    std::cerr << "no service '" << options.service << "' of namespace '" << deployment.name_space
              << "' answers in domain " << deployment.domain
              << "; is it running, and does it have methods? (quoin status shows who is there)\n";
    return exit_failure;
  }
  msg::ControlRequest request;
  request.service(options.service);
  request.action(action);
  request.method(options.method);
  request.drop_state(options.drop_state);
  add_settings(options.settings, request);
  const auto reply = requester.ask(request, deadline);
  if (!reply) {
    std::cerr << options.service << ": no answer within " << options.wait
              << " s; quoin status tells which method it has\n";
    return exit_failure;
  }
  if (options.json) {
    std::cout << to_json(*reply).dump(2, ' ', false, nlohmann::json::error_handler_t::replace)
              << '\n';
  } else {
    print(*reply);
  }
  return reply->accepted() ? exit_ok : exit_configuration;
}

/// How to reach a service, and how to answer.
void add_service_options(CLI::App& line, ControlOptions& options) {
  CLI::Option* file = line.add_option("--deployment", options.file,
                                      "Deployment file that says domain and namespace");
  add_network_options(line, options.network, file);
  line.add_option("--wait", options.wait, "How long to wait for the answer [s]")
      ->capture_default_str()
      ->transform(a_time());
  line.add_flag("--json", options.json, "The answer as a JSON object");
}

void add_options(CLI::App& line, ControlOptions& options, bool settings_required) {
  CLI::Option* settings = line.add_option("settings", options.settings,
                                          "Parameters as name=value, with or without unit")
                              ->check([](const std::string& text) {
                                const std::size_t equals = text.find('=');
                                return equals == std::string::npos || equals == 0
                                           ? "'" + text + "' is not name=value"
                                           : std::string();
                              });
  settings->required(settings_required);
  add_service_options(line, options);
  line.add_flag("--drop-state", options.drop_state,
                "Even when the new method cannot go on with what the present one has learned");
}

}  // namespace

Command add_swap(CLI::App& app) {
  CLI::App* line =
      app.add_subcommand("swap", "Exchange the method of a running service between two scans");
  const auto options = std::make_shared<ControlOptions>();
  line->add_option("service", options->service, "Name of the service")->required();
  line->add_option("method", options->method, "Its new method")->required();
  add_options(*line, *options, false);
  return {line, [options] { return run(*options, msg::ControlAction::CONTROL_SWAP_METHOD); }};
}

Command add_set(CLI::App& app) {
  CLI::App* line =
      app.add_subcommand("set", "Set parameters of a running service between two scans");
  const auto options = std::make_shared<ControlOptions>();
  line->add_option("service", options->service, "Name of the service")->required();
  add_options(*line, *options, true);
  return {line, [options] { return run(*options, msg::ControlAction::CONTROL_SET_PARAMETERS); }};
}

Command add_playback(CLI::App& app) {
  CLI::App* line = app.add_subcommand("playback", "Pause, step or speed up a running replay");
  line->require_subcommand(1);
  const auto options = std::make_shared<ControlOptions>();
  const auto value = std::make_shared<std::string>("1");
  const auto action = [&](const char* name, const char* what, const char* setting) {
    CLI::App* sub = line->add_subcommand(name, what);
    sub->add_option("service", options->service, "Name of the replay")->required();
    add_service_options(*sub, *options);
    const bool open = std::string_view(setting).ends_with('=');
    sub->callback(
        [options, value, setting, open] { options->settings = {setting + (open ? *value : "")}; });
    return sub;
  };
  action("pause", "Publish nothing until it goes on", "paused=true");
  action("resume", "Go on", "paused=false");
  action("step", "Publish the next message, or so many, and be paused then", "step=")
      ->add_option("messages", *value, "How many")
      ->check(CLI::PositiveNumber);
  action("speed", "Go on at another speed", "speed=")
      ->add_option("factor", *value, "On the recorded speed; 0 is without waiting")
      ->check(CLI::NonNegativeNumber)
      ->required();
  return {line, [options] { return run(*options, msg::ControlAction::CONTROL_SET_PARAMETERS); }};
}

}  // namespace quoin::deploy
