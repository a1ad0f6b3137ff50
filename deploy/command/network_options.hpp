// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <CLI/CLI.hpp>

#include "services/deployment/deployment.hpp"

namespace quoin::deploy {

/// Where the services of a running deployment are found without its file.
struct NetworkOptions {
  int domain = 0;
  std::string name_space = "quoin";
  NetworkText network;
};

/// `file` is the option of the deployment file, which says all of that.
void add_network_options(CLI::App& line, NetworkOptions& options, CLI::Option* file);

/// The deployment of `file`; where that is "", one without services that is found where `options`
/// say. Throws DeploymentError.
[[nodiscard]] Deployment deployment_to_reach(const NetworkOptions& options,
                                             const std::string& file);

}  // namespace quoin::deploy
