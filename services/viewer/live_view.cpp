// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/viewer/live_view.hpp"

#include <chrono>
#include <functional>
#include <idl/LineMap.h>
#include <stdexcept>
#include <tuple>
#include <utility>

#include <nlohmann/json.hpp>

#include "core/parameters/parameter.hpp"
#include "services/topics/topic_types.hpp"
#include "services/viewer/playback_remote.hpp"

namespace quoin::viewer {

namespace {

/// [ns since the Unix epoch]
std::int64_t system_now() {
  using namespace std::chrono;
  return duration_cast<nanoseconds>(system_clock::now().time_since_epoch()).count();
}

/// Messages as they are sent (CDR) with their IDL.
Channel cdr_channel(const std::string& topic, std::string_view dds_type, std::string_view idl) {
  return {0, topic, "cdr", std::string(dds_type), "omgidl", std::string(topics::idl_text(idl))};
}

/// A map comes in parts, of each of which the newest counts.
std::uint64_t key_of(const std::string& type, const topics::RawMessage& raw) {
  msg::LineMap map;
  return type == "line_map" && topics::decode(raw, map) ? map.part() : 0;
}

/// Where a sensor is on its robot, as the services are told that follow its pose.
struct SensorMounting {
  double x = 0.0;
  double y = 0.0;
  double yaw = 0.0;

  static constexpr auto fields() {
    using P = SensorMounting;
    return std::tuple{field(&P::x, "mounting_x", "m", -100.0, 100.0, ""),
                      field(&P::y, "mounting_y", "m", -100.0, 100.0, ""),
                      field(&P::yaw, "mounting_yaw", "rad", -6.2832, 6.2832, "")};
  }
};

/// JSON: {service: {"x": .., "y": .., "yaw": ..}} of the services of which the file says it.
std::string mountings_of(const Deployment& deployment) {
  auto mountings = nlohmann::json::object();
  for (const ServiceConfig& service : deployment.services) {
    ParameterSettings settings;
    for (const ParameterSetting& setting : service.parameters) {
      if (setting.name.starts_with("mounting_") && setting.name != "mounting_z") {
        settings.push_back(setting);
      }
    }
    if (settings.empty()) continue;
    const auto mounting = make_parameters<SensorMounting>(settings);
    mountings[service.name] = {{"x", mounting.x}, {"y", mounting.y}, {"yaw", mounting.yaw}};
  }
  return mountings.dump();
}

}  // namespace

LiveView::LiveView(const Deployment& deployment, const ViewerParameters& parameters,
                   const std::filesystem::path& base, Server::Log log)
    : hub_(deployment.name_space),
      explainer_(deployment),
      heartbeats_(hub_.add_channel(cdr_channel(status_topic(deployment.name_space),
                                               "quoin::msg::ServiceStatus", "Status.idl"))),
      heartbeat_topic_(status_topic(deployment.name_space)),
      views_(hub_),
      heartbeat_views_(hub_),
      server_(server_settings(parameters, base), hub_, std::move(log)) {
  hub_.add_service("explain",
                   [this](const std::string& request) { return explainer_.answer(request); });
  hub_.add_service("mountings", [mountings = mountings_of(deployment)](const std::string&) {
    return mountings;
  });
  heartbeat_views_.add(heartbeat_topic_, "status");
  if (!controllable_replays(deployment).empty()) {
    hub_.add_service("playback", [this](const std::string& request) {
      const std::lock_guard lock(playback_mutex_);
      if (!playback_) throw std::runtime_error("not yet; ask again in a moment");
      return playback_(request);
    });
  }
  hub_.limit(static_cast<std::size_t>(parameters.clients), client_limits(parameters));
}

std::uint32_t LiveView::channel_of(const std::string& topic, const std::string& type) {
  const auto found = channels_.find(topic);
  if (found != channels_.end()) return found->second;
  const topics::TopicType& row = *topics::find_topic_type(type);
  const std::uint32_t id = hub_.add_channel(cdr_channel(topic, row.dds_type, row.idl));
  channels_.emplace(topic, id);
  views_.add(topic, type);
  return id;
}

void LiveView::publish(const std::string& topic, const std::string& type,
                       std::shared_ptr<const void> owner, const topics::RawMessage& raw,
                       const msg::Header& header) {
  const Payload payload{std::move(owner), raw.cdr, system_now()};
  if (type == "scan") explainer_.add(topic, header.stamp(), payload);
  hub_.publish(channel_of(topic, type), payload, key_of(type, raw));
  views_.publish(topic, raw.cdr, header.frame(), header.stamp());
}

void LiveView::answer_playback(Hub::Service service) {
  const std::lock_guard lock(playback_mutex_);
  playback_ = std::move(service);
}

void LiveView::publish(const msg::ServiceStatus& heartbeat) {
  const auto raw = std::make_shared<topics::RawMessage>();
  topics::encode(heartbeat, *raw);
  hub_.publish(heartbeats_, {raw, raw->cdr, system_now()},
               std::hash<std::string>{}(heartbeat.service()));
  heartbeat_views_.publish(heartbeat_topic_, raw->cdr, "", heartbeat.stamp());
}

}  // namespace quoin::viewer
