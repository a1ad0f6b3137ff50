// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "deploy/quoin/network_options.hpp"

namespace quoin::deploy {

void add_network_options(CLI::App& line, NetworkOptions& options, CLI::Option* file) {
  line.add_option("--domain", options.domain, "DDS domain")
      ->check(CLI::Range(0, 232))
      ->excludes(file);
  line.add_option("--namespace", options.name_space, "Namespace of the topics")->excludes(file);
}

Deployment deployment_to_reach(const NetworkOptions& options, const std::string& file) {
  if (!file.empty()) return load_deployment(file);
  Deployment deployment;
  deployment.domain = options.domain;
  deployment.name_space = options.name_space;
  return deployment;
}

}  // namespace quoin::deploy
