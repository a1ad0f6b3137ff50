// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "deploy/diagnostics/check.hpp"
#include "services/deployment/deployment.hpp"

namespace quoin::deploy {

/// Whether the kernel grants sockets buffers of `wanted` bytes; `folder` is /proc/sys/net/core.
[[nodiscard]] Check check_socket_buffers(const std::filesystem::path& folder, std::uint64_t wanted);

/// Whether the kernel soon forgets datagrams of which a part was lost: until then they take the
/// place of others; `folder` is /proc/sys/net/ipv4.
[[nodiscard]] Check check_reassembly(const std::filesystem::path& folder);

/// An interface of this host that a deployment names.
struct NamedInterface {
  std::string name;
  std::string address;
  bool running = true;
};

/// Whether `interfaces`, those of `network` that this host has, are there, have a link and, where
/// discovery needs it, multicast. `interface_folder` is /sys/class/net, `routes` /proc/net/route.
[[nodiscard]] Checks check_network(const NetworkConfig& network,
                                   const std::vector<NamedInterface>& interfaces,
                                   const std::filesystem::path& interface_folder,
                                   const std::filesystem::path& routes);

/// Whether there is room where files are written.
[[nodiscard]] Check check_disk(const std::filesystem::path& folder, std::uint64_t capacity,
                               std::uint64_t available);

/// Whether the programs of all kinds of services are in `folder`.
[[nodiscard]] Check check_programs(const std::filesystem::path& folder);

/// Services that run on this host with nobody to watch over them; `processes` is /proc.
[[nodiscard]] Check check_orphans(const std::filesystem::path& processes);

/// Whether the process that has the right to run `deployment` here still acts; `sockets` is
/// /proc/net/unix, `processes` /proc.
[[nodiscard]] Check check_supervisor(const Deployment& deployment,
                                     const std::filesystem::path& sockets,
                                     const std::filesystem::path& processes);

}  // namespace quoin::deploy
