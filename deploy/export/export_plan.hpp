// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "deploy/deployment/deployment.hpp"

namespace quoin::deploy {

/// A service as another supervisor has to run it.
struct ExportedService {
  const ServiceConfig* config = nullptr;
  std::string label;    ///< of the service in the deployment file
  std::string id;       ///< the same for names of units and containers
  std::string program;  ///< file name of the executable
  /// Those that have to be there first, by id: who reads the output, and for sources what stands in
  /// for their device. Stopped in the opposite order, nothing in flight is lost.
  std::vector<std::string> after;
  bool may_finish = false;  ///< a source that can come to its end
  /// Serial port that is needed: a path, or "auto"; nothing where there is none.
  std::optional<std::string> serial_port;
  /// Speaks to addresses that the deployment's network does not name.
  bool own_network = false;
};

/// The part of a deployment that runs on one host.
struct ExportPlan {
  const Deployment* deployment = nullptr;
  std::filesystem::path file;  ///< of the deployment, absolute
  std::string id;              ///< quoin-NAMESPACE, / replaced
  std::vector<ExportedService> services;
};

/// `host`: "" for a deployment that names no hosts. Throws std::out_of_range when the host fits
/// not.
[[nodiscard]] ExportPlan plan_export(const Deployment& deployment, const std::string& host);

}  // namespace quoin::deploy
