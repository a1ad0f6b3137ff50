// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <idl/Common.h>
#include <idl/Status.h>
#include <map>
#include <memory>
#include <mutex>
#include <string>

#include "services/deployment/deployment.hpp"
#include "services/topics/cdr_codec.hpp"
#include "services/viewer/explainer.hpp"
#include "services/viewer/foxglove_channels.hpp"
#include "services/viewer/hub.hpp"
#include "services/viewer/server.hpp"
#include "services/viewer/settings.hpp"

namespace quoin::viewer {

/// The page of a deployment: its server, and a channel for each topic that something has come by,
/// with those that Foxglove draws.
class LiveView {
 public:
  /// Paths of the parameters count from `base`. Throws what Server and server_settings throw.
  LiveView(const Deployment& deployment, const ViewerParameters& parameters,
           const std::filesystem::path& base, Server::Log log);

  /// A message of that topic and type (of the table of topic types), which `owner` keeps alive. One
  /// thread at a time.
  void publish(const std::string& topic, const std::string& type, std::shared_ptr<const void> owner,
               const topics::RawMessage& raw, const msg::Header& header);
  void publish(const msg::ServiceStatus& heartbeat);

  /// What answers the page's requests to pause, step or speed up replays; nullptr: nobody.
  void answer_playback(Hub::Service service);

  [[nodiscard]] Hub& hub() { return hub_; }
  [[nodiscard]] std::string url() const { return server_.url(); }

 private:
  [[nodiscard]] std::uint32_t channel_of(const std::string& topic, const std::string& type);

  Hub hub_;
  Explainer explainer_;
  const std::uint32_t heartbeats_;  // channel
  const std::string heartbeat_topic_;
  FoxgloveChannels views_;
  FoxgloveChannels heartbeat_views_;               // heartbeats come by another thread
  std::map<std::string, std::uint32_t> channels_;  // by topic
  std::mutex playback_mutex_;
  Hub::Service playback_;
  Server server_;
};

}  // namespace quoin::viewer
