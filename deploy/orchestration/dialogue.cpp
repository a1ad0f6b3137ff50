// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "deploy/orchestration/dialogue.hpp"

#include <algorithm>
#include <map>
#include <utility>

namespace quoin::deploy {

namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using Clock = std::chrono::steady_clock;

// A service answers within five seconds, or is killed.
constexpr milliseconds answer_timeout{5500};

void set_method(const ServiceConfig& config, msg::ControlRequest& request) {
  request.method(config.method);
  for (const ParameterSetting& setting : config.parameters) {
    msg::ParameterSetting& out = request.parameters().emplace_back();
    out.name(setting.name);
    out.value(setting.text);
  }
}

/// Takes over what a service says of its method, if this build knows it.
void set_method(const msg::ControlReply& reply, ServiceConfig& service) {
  const auto& methods = service.info->methods;
  if (std::none_of(methods.begin(), methods.end(),
                   [&](const MethodInfo& method) { return method.name == reply.method(); })) {
    return;
  }
  service.method = reply.method();
  service.parameters.clear();
  for (const msg::ParameterSetting& setting : reply.parameters()) {
    service.parameters.push_back({setting.name(), setting.value()});
  }
}

}  // namespace

Dialogue::Dialogue(const SupervisedProcesses& processes, Requester& requester,
                   std::function<bool()> pump)
    : processes_(processes), requester_(requester), pump_(std::move(pump)) {}

std::optional<msg::ControlReply> Dialogue::ask(const std::string& service,
                                               std::uint64_t incarnation,
                                               msg::ControlAction action) {
  msg::ControlRequest request;
  request.action(action);
  return ask(service, incarnation, std::move(request));
}

std::optional<msg::ControlReply> Dialogue::ask(const std::string& service,
                                               std::uint64_t incarnation,
                                               msg::ControlRequest request) {
  request.service(service);
  request.incarnation(incarnation);
  // Only the first request to a process can get lost: before the endpoints are matched.
  const bool question = request.action() == msg::ControlAction::CONTROL_DESCRIBE;
  const auto deadline = now() + (question ? milliseconds(3000) : answer_timeout);
  do {
    if (const auto reply = answer(request, question ? milliseconds(300) : answer_timeout)) {
      return reply;
    }
  } while (now() < deadline && !processes_.stopping());
  return std::nullopt;
}

Dialogue::Swap Dialogue::swap(const ServiceConfig& config) {
  if (!ask(label(config), 0, msg::ControlAction::CONTROL_DESCRIBE)) return {"does not answer"};
  msg::ControlRequest request;
  request.service(label(config));
  request.action(msg::ControlAction::CONTROL_SWAP_METHOD);
  set_method(config, request);
  request.drop_state(true);  // the plan has said so
  const auto reply = answer(request, answer_timeout);
  if (!reply) return {"does not answer"};
  if (!reply->accepted()) return {"refuses: " + reply->detail()};
  if (!reply->detail().empty()) return {};
  return {"", reply->first_sequence_number()};
}

Deployment Dialogue::describe(const Deployment& deployment) {
  Deployment described = deployment;
  std::map<std::uint64_t, ServiceConfig*> asked;
  for (ServiceConfig& service : described.services) {
    const auto key = processes_.key_of(label(service));
    if (service.method.empty() || !key || !processes_.running(*key)) continue;
    msg::ControlRequest request;
    request.service(label(service));
    request.action(msg::ControlAction::CONTROL_DESCRIBE);
    asked[requester_.send(request)] = &service;
  }
  const auto all_have_answered = [&] {
    std::erase_if(asked, [&](const auto& entry) {
      const auto reply = requester_.take(entry.first);
      if (reply) set_method(*reply, *entry.second);
      return reply.has_value();
    });
    return asked.empty();
  };
  wait_until(all_have_answered, seconds(1));
  return described;
}

bool Dialogue::wait_until(const std::function<bool()>& condition, milliseconds timeout) {
  const auto deadline = now() + timeout;
  while (!condition()) {
    if (now() >= deadline || !pump()) return false;
  }
  return true;
}

std::optional<msg::ControlReply> Dialogue::answer(msg::ControlRequest& request,
                                                  milliseconds timeout) {
  const std::uint64_t number = requester_.send(request);
  std::optional<msg::ControlReply> reply;
  wait_until([&] { return (reply = requester_.take(number)).has_value(); }, timeout);
  return reply;
}

}  // namespace quoin::deploy
