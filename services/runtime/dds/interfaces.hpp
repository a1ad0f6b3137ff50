// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "services/deployment/deployment.hpp"

namespace quoin::runtime {

/// An IPv4 address of this host.
struct InterfaceAddress {
  std::string interface;  ///< its name
  std::string address;
  bool running = true;  ///< up, with a link
};

/// The IPv4 addresses that this host has now. Throws std::system_error.
[[nodiscard]] std::vector<InterfaceAddress> host_addresses();

/// Name of this host, as in the heartbeats of its services.
[[nodiscard]] std::string host_name();

/// What participants ask for; holds several scans, so that a burst does not overflow a socket. The
/// kernel may grant less.
inline constexpr std::uint32_t socket_buffer_bytes = 4U << 20U;

/// Those of `host` that one of `interfaces` (names, addresses, networks) stands for.
[[nodiscard]] std::vector<InterfaceAddress> named_interfaces(
    const std::vector<std::string>& interfaces, const std::vector<InterfaceAddress>& host);

/// The addresses among `host` that one of `interfaces` (names, addresses, networks) stands for, in
/// the order of `host`; 127.0.0.1 when `interfaces` is empty. Throws std::runtime_error, with what
/// the host has, when there is none, or none of them has a link.
[[nodiscard]] std::vector<std::string> resolve_interfaces(
    const std::vector<std::string>& interfaces, const std::vector<InterfaceAddress>& host);

/// Indexes of the discovery servers in `network` that run on a host with these addresses.
[[nodiscard]] std::vector<std::size_t> servers_here(const NetworkConfig& network,
                                                    const std::vector<std::string>& addresses);

}  // namespace quoin::runtime
