// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "deploy/deployment/deployment.hpp"

namespace quoin::runtime {

/// How a process takes part in DDS.
struct ParticipantConfig {
  int domain = 0;
  std::string name;  ///< shown by DDS tools
  deploy::NetworkConfig network = {};
  std::optional<deploy::SecurityConfig> security = {};
  std::string identity = {};  ///< whose keys it has, with security
};

/// Of a participant that takes part in `deployment` as <namespace>/`name`, where security is on
/// with the keys of `identity`, or of `name` where that is "". Throws DeploymentError when they do
/// not let it.
[[nodiscard]] ParticipantConfig participant_config(const deploy::Deployment& deployment,
                                                   const std::string& name,
                                                   std::string_view identity = "");

/// A DDS participant that speaks UDP on 127.0.0.1 alone: it opens no other interface, sends no
/// multicast and leaves no shared-memory file. Throws std::runtime_error when it cannot be created.
class Participant {
 public:
  explicit Participant(const ParticipantConfig& config);
  ~Participant();
  Participant(const Participant&) = delete;
  Participant& operator=(const Participant&) = delete;

  struct Impl;
  [[nodiscard]] Impl& impl() { return *impl_; }

 private:
  std::unique_ptr<Impl> impl_;
};

}  // namespace quoin::runtime
