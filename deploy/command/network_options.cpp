// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "deploy/command/network_options.hpp"

#include "deploy/kinds/kinds.hpp"

namespace quoin::deploy {

void add_network_options(CLI::App& line, NetworkOptions& options, CLI::Option* file) {
  line.add_option("--domain", options.domain, "DDS domain")
      ->check(CLI::Range(0, 232))
      ->excludes(file);
  line.add_option("--namespace", options.name_space, "Namespace of the topics")->excludes(file);
  const auto add_list = [&](const char* name, std::vector<std::string>& texts, const char* what) {
    line.add_option(name, texts, what)
        ->excludes(file)
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  };
  NetworkText& network = options.network;
  add_list("--interface", network.interfaces,
           "Interface, IPv4 address or network to use; may be repeated; else 127.0.0.1 alone");
  line.add_option("--discovery", network.discovery, "multicast, server or peers")->excludes(file);
  add_list("--peer", network.peers, "IPv4 address of a host; may be repeated");
  add_list("--server", network.servers, "ADDRESS[:PORT] of a discovery server; may be repeated");
}

Deployment deployment_to_reach(const NetworkOptions& options, const std::string& file) {
  if (!file.empty()) return load_deployment(file);
  Deployment deployment;
  deployment.domain = options.domain;
  deployment.name_space = options.name_space;
  deployment.network = parse_network(options.network);
  return deployment;
}

}  // namespace quoin::deploy
