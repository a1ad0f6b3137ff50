// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/methods/parameter.hpp"

namespace quoin::deploy {

/// Place in a file, both from 1.
struct Position {
  int line = 0;
  int column = 0;
};

/// What to do when a service's process dies.
enum class RestartPolicy {
  always,  ///< start it again, with back-off
  never,   ///< leave it dead
};

struct ServiceConfig {
  std::string name;
  std::string kind;
  std::string input;  ///< name of the service whose output is read; "" for sources
  std::string
      method;       ///< the kind's default when the file names none; "" for kinds without methods
  std::string qos;  ///< preset of the output topic: sensor, feature, state or lossless
  ParameterSettings parameters;  ///< validated against the method or kind
  RestartPolicy restart = RestartPolicy::always;
  Position position;  ///< of the service in the file
};

/// A deployment file, validated: every name exists, every input fits, there is no cycle.
struct Deployment {
  std::filesystem::path file;
  std::string name_space;               ///< prefix of all topics
  int domain = 0;                       ///< DDS domain, 0..232
  std::vector<ServiceConfig> services;  ///< inputs before those who read them

  /// Throws std::out_of_range when there is no such service.
  [[nodiscard]] const ServiceConfig& service(std::string_view name) const;
  /// Services that read the output of `name`.
  [[nodiscard]] std::vector<const ServiceConfig*> readers_of(std::string_view name) const;
};

/// One or more things wrong with a deployment file, each as "file:line:column: what; what to do",
/// joined by line feeds in what().
class DeploymentError : public std::runtime_error {
 public:
  explicit DeploymentError(std::vector<std::string> messages);
  [[nodiscard]] const std::vector<std::string>& messages() const { return messages_; }

 private:
  std::vector<std::string> messages_;
};

/// Reads and validates a deployment file. Throws DeploymentError with all that is wrong.
[[nodiscard]] Deployment load_deployment(const std::filesystem::path& file);

/// The text of a deployment file, not more of it than parse_deployment takes. Throws
/// DeploymentError.
[[nodiscard]] std::string read_deployment(const std::filesystem::path& file);

/// The same as load_deployment for text already in memory; `file` is what messages name.
[[nodiscard]] Deployment parse_deployment(const std::string& text,
                                          const std::filesystem::path& file);

/// Topic names: <namespace>/<service>/<type in lower case>, "" of a service that publishes nothing,
/// and two shared by all services.
[[nodiscard]] std::string output_topic(const Deployment& deployment, const ServiceConfig& service);
[[nodiscard]] std::string status_topic(std::string_view name_space);
[[nodiscard]] std::string control_request_topic(std::string_view name_space);
[[nodiscard]] std::string control_reply_topic(std::string_view name_space);

/// What control requests to the supervisor of a deployment are addressed to; no service has it.
inline constexpr std::string_view supervisor_name = "@";

}  // namespace quoin::deploy
