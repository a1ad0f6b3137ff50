// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "deploy/export/export_plan.hpp"

namespace quoin::deploy {

struct ComposeOptions {
  std::string image;
  std::string serial_port = "/dev/ttyUSB0";  ///< stands in for "auto"
};

/// A Compose file with a container for each service, on the host's network.
[[nodiscard]] std::string compose_file(const ExportPlan& plan, const ComposeOptions& options);

}  // namespace quoin::deploy
