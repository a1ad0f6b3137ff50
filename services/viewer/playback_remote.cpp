// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/viewer/playback_remote.hpp"

#include <algorithm>
#include <memory>
#include <stdexcept>

#include <nlohmann/json.hpp>

namespace quoin::viewer {

std::vector<std::string> controllable_replays(const Deployment& deployment) {
  std::vector<std::string> replays;
  if (deployment.security) return replays;
  for (const ServiceConfig& service : deployment.services) {
    if (service.kind == "replay") replays.push_back(label(service));
  }
  return replays;
}

PlaybackRemote::PlaybackRemote(runtime::Participant& participant, const Deployment& deployment)
    : replays_(controllable_replays(deployment)),
      writer_(participant, control_request_topic(deployment.name_space),
              runtime::QosPreset::control) {}

std::string PlaybackRemote::answer(const std::string& text) {
  const nlohmann::json request = nlohmann::json::parse(text);
  msg::ControlRequest control;
  control.requester("page");
  control.action(msg::ControlAction::CONTROL_SET_PARAMETERS);
  const auto set = [&](const char* name, const std::string& value) {
    msg::ParameterSetting& setting = control.parameters().emplace_back();
    setting.name(name);
    setting.value(value);
  };
  if (request.contains("paused")) {
    set("paused", request.at("paused").get<bool>() ? "true" : "false");
  }
  if (request.contains("step")) set("step", std::to_string(request.at("step").get<unsigned>()));
  if (request.contains("speed"))
    set("speed", nlohmann::json(request.at("speed").get<double>()).dump());
  if (control.parameters().empty()) throw std::invalid_argument("neither paused, step nor speed");

  std::vector<std::string> asked = replays_;
  if (request.contains("service")) asked = {request.at("service").get<std::string>()};
  const std::lock_guard lock(mutex_);
  for (const std::string& service : asked) {
    if (std::ranges::count(replays_, service) == 0) {
      throw std::invalid_argument("'" + service + "' is no replay of this deployment");
    }
    control.service(service);
    control.request(++number_);
    if (!writer_.write(control)) throw std::runtime_error("the request could not be sent");
  }
  return nlohmann::json{{"asked", asked}}.dump();
}

PlaybackAnswers::PlaybackAnswers(LiveView& view, runtime::Participant& participant,
                                 const Deployment& deployment)
    : view_(view) {
  if (controllable_replays(deployment).empty()) return;
  const auto remote = std::make_shared<PlaybackRemote>(participant, deployment);
  view.answer_playback([remote](const std::string& request) { return remote->answer(request); });
}

PlaybackAnswers::~PlaybackAnswers() { view_.answer_playback(nullptr); }

}  // namespace quoin::viewer
