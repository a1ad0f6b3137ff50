// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "services/deployment/deployment.hpp"

namespace quoin::deploy {

/// A process as another supervisor has to run it: of one service or of several, or the discovery
/// servers of a host.
struct ExportedProcess {
  std::string name;                       ///< in the deployment file, of a service by its label
  std::string id;                         ///< the same for names of units and containers
  std::string kind;                       ///< of the service, "discovery", or "walls, corners"
  bool composed = false;                  ///< of several services
  std::string program;                    ///< file name of the executable
  std::vector<std::string> command = {};  ///< of kind external: the whole command line
  RestartPolicy restart = RestartPolicy::always;
  /// Those that have to be there first, by id: who reads the output, and for sources what stands in
  /// for their device. Stopped in the opposite order, nothing in flight is lost.
  std::vector<std::string> after;
  bool may_finish = false;  ///< a source that can come to its end
  /// Serial port that is needed: a path, or "auto"; nothing where there is none.
  std::optional<std::string> serial_port;
  /// Speaks to addresses that the deployment's network does not name.
  bool own_network = false;

  /// Whether it is a program of this project that reports to its supervisor.
  [[nodiscard]] bool runs_services() const { return kind != "discovery" && command.empty(); }
  /// Of the program, when the deployment's file is at `file`.
  [[nodiscard]] std::vector<std::string> arguments(const std::filesystem::path& file) const;
};

/// The part of a deployment that runs on one host.
struct ExportPlan {
  const Deployment* deployment = nullptr;
  std::filesystem::path file;  ///< of the deployment, absolute
  std::string id;              ///< quoin-NAMESPACE, / replaced
  std::vector<ExportedProcess> processes;
};

/// The share of `host`, "" for a deployment that names no hosts; with its discovery servers, if
/// there are any. Throws sensor_bridge::EndpointError for a device that is none.
[[nodiscard]] ExportPlan plan_export(const Deployment& deployment, const std::string& host,
                                     bool discovery_servers = false);

}  // namespace quoin::deploy
