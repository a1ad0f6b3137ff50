// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "services/deployment/deployment.hpp"

namespace quoin::runtime {

/// What RTPS calls a participant or an endpoint in all of the domain: 12 bytes of the participant,
/// 4 of the entity.
using Guid = std::array<std::uint8_t, 16>;

/// A reader or writer of a participant that belongs to a service, see TopicQos::owner.
struct OwnedEndpoint {
  Guid guid{};
  std::string owner;
  bool writes = false;

  friend bool operator==(const OwnedEndpoint&, const OwnedEndpoint&) = default;
};

/// The DDS that this program was built with, such as "Fast DDS 3.1.2".
[[nodiscard]] std::string_view dds_version();

/// A topic that others write.
struct WrittenTopic {
  std::string topic;
  std::string type;      ///< as DDS has it
  bool reliable = true;  ///< all writers are
  bool transient_local = true;

  friend bool operator==(const WrittenTopic&, const WrittenTopic&) = default;
};

/// How a process takes part in DDS.
struct ParticipantConfig {
  int domain = 0;
  std::string name;  ///< shown by DDS tools
  NetworkConfig network = {};
  /// It is this one of the network's discovery servers.
  std::optional<std::size_t> server = std::nullopt;
  /// Programs write for it that are none of this project, in messages of any size.
  bool strangers = false;
  std::optional<SecurityConfig> security = {};
  std::string identity = {};  ///< whose keys it has, with security
  /// Topics that it only looks at. Writers that start later can wait for it before their first
  /// message, see WriterBase::awaited_observers. Of more than 128 the rest is not announced.
  std::vector<std::string> observes = {};
  /// What others find beside that, as "key=value;" where they read it so.
  std::string user_data = {};
};

/// Of a participant that takes part in `deployment` as <namespace>/`name`, where security is on
/// with the keys of `identity`, or of `name` where that is "". Throws DeploymentError when they do
/// not let it.
[[nodiscard]] ParticipantConfig participant_config(const Deployment& deployment,
                                                   const std::string& name,
                                                   std::string_view identity = "");

/// A DDS participant that speaks UDP on the interfaces of its network alone (127.0.0.1 when that
/// names none), sends multicast only for Discovery::multicast, and leaves no shared-memory file.
/// Throws std::runtime_error when it cannot be created.
class Participant {
 public:
  explicit Participant(const ParticipantConfig& config);
  ~Participant();
  Participant(const Participant&) = delete;
  Participant& operator=(const Participant&) = delete;

  /// Topics that other participants are known to write to.
  [[nodiscard]] std::vector<std::string> written_topics() const;
  [[nodiscard]] std::vector<WrittenTopic> written() const;
  /// True once the participants that were there before this one are known, unless the network or
  /// the machine is slow; with Discovery::server not before a server answered.
  [[nodiscard]] bool discovery_complete() const;

  [[nodiscard]] Guid guid() const;
  /// Calls `watcher` at once and whenever a reader or writer with an owner (TopicQos::owner) is
  /// made or ends, with all of them in the order in which they were made; null for nobody. By
  /// whoever makes or ends them, one call at a time; it makes none with an owner itself.
  void watch_endpoints(std::function<void(const std::vector<OwnedEndpoint>&)> watcher);

  struct Impl;
  [[nodiscard]] Impl& impl() { return *impl_; }

 private:
  std::unique_ptr<Impl> impl_;
};

}  // namespace quoin::runtime
