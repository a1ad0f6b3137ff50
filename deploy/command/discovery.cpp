// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include <deque>
#include <iostream>
#include <memory>
#include <poll.h>
#include <string>

#include "deploy/command/commands.hpp"
#include "deploy/kinds/kinds.hpp"
#include "deploy/orchestration/signals.hpp"
#include "services/deployment/deployment.hpp"
#include "services/runtime/dds/interfaces.hpp"
#include "services/runtime/dds/participant.hpp"
#include "services/runtime/process/heartbeat.hpp"

namespace quoin::deploy {

namespace {

std::string text_of(const ServerAddress& server) {
  return server.address + ":" + std::to_string(server.port);
}

int run(const std::string& file) {
  const Deployment deployment = load_deployment(file);
  const NetworkConfig& network = deployment.network;
  const auto addresses = runtime::resolve_interfaces(network.interfaces, runtime::host_addresses());
  const auto servers = runtime::servers_here(network, addresses);
  if (servers.empty()) {
    // The same command may be given on all hosts.
    std::string all;
    for (const ServerAddress& server : network.servers) all += " " + text_of(server);
    std::cerr << file << ": no discovery server is on this host; it has"
              << (all.empty() ? " none" : all) << '\n';
    return exit_ok;
  }
  Signals signals;  // before DDS starts its threads
  signals.end_when_stuck();
  std::deque<runtime::Participant> participants;
  for (const std::size_t index : servers) {
    const std::string name = "discovery_" + std::to_string(index);
    auto config = runtime::participant_config(deployment, name);
    config.server = index;
    participants.emplace_back(config);
    std::cerr << "discovery server at " << text_of(network.servers[index]) << std::endl;
  }
  runtime::MemoryTrim memory_trim;
  while (signals.take() == 0) {
    pollfd signal{signals.descriptor(), POLLIN, 0};
    ::poll(&signal, 1, 5000);
    memory_trim.tick();
  }
  return exit_ok;
}

}  // namespace

Command add_discovery(CLI::App& app) {
  CLI::App* line = app.add_subcommand(
      "discovery",
      "Run the discovery servers of a deployment that are on this host, until SIGTERM");
  const auto file = std::make_shared<std::string>();
  line->add_option("file", *file, "Deployment file (YAML)")->required();
  return {line, [file] { return run(*file); }};
}

}  // namespace quoin::deploy
