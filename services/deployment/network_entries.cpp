// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/deployment/network_entries.hpp"

#include <algorithm>
#include <arpa/inet.h>
#include <charconv>

#include "core/parameters/parameter.hpp"
#include "services/deployment/parameter_entries.hpp"

namespace quoin {

namespace {

constexpr std::size_t longest_interface = 15;  // of the kernel
constexpr std::size_t most_addresses = 64;
constexpr int default_server_port = 11811;
const std::vector<std::string> distro_names{"humble", "iron", "jazzy", "rolling"};  // of RosDistro

bool is_address(const std::string& text) {
  in_addr address{};
  return ::inet_pton(AF_INET, text.c_str(), &address) == 1;
}

/// An IPv4 network such as 10.7.0.0/24.
bool is_prefix(const std::string& text) {
  const std::size_t slash = text.find('/');
  if (slash == std::string::npos || !is_address(text.substr(0, slash))) return false;
  const std::string bits = text.substr(slash + 1);
  return !bits.empty() && bits.size() <= 2 && only_of(bits, "0123456789") && std::stoi(bits) <= 32;
}

bool is_interface(const std::string& text) {
  return !text.empty() && text.size() <= longest_interface &&
         !only_of(text, "0123456789.") &&  // a mistyped address
         only_of(text, "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-._@");
}

std::vector<std::string> read_interfaces(const Entry& entry, Problems& problems) {
  std::vector<std::string> interfaces;
  for (const Entry& element : read_list(entry, problems)) {
    const std::string text = element.value.Scalar();
    if (!is_interface(text) && !is_address(text) && !is_prefix(text)) {
      problems.add(element.value_at, "'" + text +
                                         "' is no interface; write a name such as eth0, an IPv4 "
                                         "address or a network such as 10.7.0.0/24");
    }
    interfaces.push_back(text);
  }
  return interfaces;
}

std::vector<std::string> read_peers(const Entry& entry, Problems& problems) {
  std::vector<std::string> peers;
  for (const Entry& element : read_list(entry, problems)) {
    const std::string text = element.value.Scalar();
    if (!is_address(text)) {
      problems.add(element.value_at, "the peer '" + text + "' must be an IPv4 address");
    }
    peers.push_back(text);
  }
  return peers;
}

std::vector<ServerAddress> read_servers(const Entry& entry, Problems& problems) {
  std::vector<ServerAddress> servers;
  for (const Entry& element : read_list(entry, problems)) {
    const std::string text = element.value.Scalar();
    const std::size_t colon = text.find(':');
    ServerAddress server{text.substr(0, colon), default_server_port};
    int port = default_server_port;
    if (colon != std::string::npos) {
      const char* const end = text.data() + text.size();
      const auto [rest, error] = std::from_chars(text.data() + colon + 1, end, port);
      if (error != std::errc{} || rest != end) port = 0;
    }
    if (!is_address(server.address) || port < 1 || port > 65535) {
      problems.add(element.value_at, "the server '" + text +
                                         "' must be an IPv4 address, or ADDRESS:PORT (port " +
                                         std::to_string(default_server_port) + " by default)");
    }
    server.port = static_cast<std::uint16_t>(port);
    servers.push_back(server);
  }
  return servers;
}

Discovery discovery_of(const std::string& name) {
  if (name == "multicast") return Discovery::multicast;
  return name == "server" ? Discovery::server : Discovery::peers;
}

}  // namespace

NetworkConfig read_network(const Entry& entry, Problems& problems) {
  NetworkConfig network;
  if (!entry.value.IsMap()) {
    problems.add(entry.value_at, "'network' must be a map with interfaces and discovery, not " +
                                     what_is(entry.value));
    return network;
  }
  std::optional<std::string> discovery;
  std::optional<double> lease;
  std::optional<Entry> peers, servers;
  for (const Entry& element : entries_of(entry.value, "the network", problems)) {
    if (element.key == "interfaces") {
      network.interfaces = read_interfaces(element, problems);
    } else if (element.key == "discovery") {
      discovery = read_choice(element, "discovery", {"multicast", "server", "peers"}, problems);
    } else if (element.key == "peers") {
      peers = element;
      network.peers = read_peers(element, problems);
    } else if (element.key == "servers") {
      servers = element;
      network.servers = read_servers(element, problems);
    } else if (element.key == "lease") {
      lease = read_seconds(element, "the lease", 0.5, 600.0, problems);
    } else {
      problems.add(element.key_at, "unknown key '" + element.key + "' of the network" +
                                       suggestion(element.key, {"interfaces", "discovery", "peers",
                                                                "servers", "lease"}));
    }
  }
  if (network.peers.size() + network.servers.size() > most_addresses) {
    problems.add(entry.key_at, "more than " + std::to_string(most_addresses) + " addresses");
  }
  const bool loopback = network.interfaces.empty();
  if (!discovery) {
    discovery = servers ? "server" : peers || loopback ? "peers" : "multicast";
  }
  network.discovery = discovery_of(*discovery);
  network.lease = lease.value_or(loopback ? loopback_lease : network_lease);
  if (peers && *discovery != "peers") {
    problems.add(peers->key_at, "'peers' are for discovery: peers, not for " + *discovery);
  }
  if (servers && *discovery != "server") {
    problems.add(servers->key_at, "'servers' are for discovery: server, not for " + *discovery);
  }
  if (*discovery == "server" && network.servers.empty()) {
    problems.add(entry.key_at,
                 "discovery: server needs servers; add servers: [ADDRESS, ...] (two, so that one "
                 "may fail)");
  }
  if (*discovery == "peers" && !loopback && network.peers.empty()) {
    problems.add(entry.key_at,
                 "discovery: peers needs the addresses of the hosts; add peers: [ADDRESS, ...]");
  }
  if (loopback && (*discovery == "multicast" || !network.peers.empty())) {
    problems.add(entry.key_at,
                 "the network names no interfaces; add interfaces: [NAME, ...], or "
                 "remove 'network' to stay on this host");
  }
  return network;
}

NetworkConfig parse_network(const NetworkText& text) {
  YAML::Node map(YAML::NodeType::Map);
  if (!text.interfaces.empty()) map["interfaces"] = text.interfaces;
  if (!text.discovery.empty()) map["discovery"] = text.discovery;
  if (!text.peers.empty()) map["peers"] = text.peers;
  if (!text.servers.empty()) map["servers"] = text.servers;
  if (map.size() == 0) return {};
  Problems problems("");
  NetworkConfig network = read_network({"network", {}, map, {}}, problems);
  problems.raise();
  return network;
}

std::optional<SecurityConfig> read_security(const Entry& entry, const std::filesystem::path& base,
                                            Problems& problems) {
  if (!entry.value.IsMap()) {
    problems.add(entry.value_at,
                 "'security' must be a map with the key 'keys', not " + what_is(entry.value));
    return std::nullopt;
  }
  std::optional<SecurityConfig> security;
  bool encrypt = true;
  bool keys = false;
  for (const Entry& element : entries_of(entry.value, "security", problems)) {
    if (element.key == "keys") {
      keys = true;
      const auto text = read_text(element, problems);
      if (text) {
        security = SecurityConfig{std::filesystem::absolute(base / *text).lexically_normal()};
      }
    } else if (element.key == "encrypt") {
      const auto text = read_choice(element, "value of encrypt", {"true", "false"}, problems);
      encrypt = text != "false";
    } else {
      problems.add(element.key_at, "unknown key '" + element.key + "' of security" +
                                       suggestion(element.key, {"keys", "encrypt"}));
    }
  }
  if (!keys) {
    problems.add(entry.key_at,
                 "security has no keys; add keys: DIRECTORY (quoin keys init makes one)");
  }
  if (security) security->encrypt = encrypt;
  return security;
}

std::optional<RosDistro> read_ros(const Entry& entry, Problems& problems) {
  if (!entry.value.IsMap()) {
    problems.add(entry.value_at, "'ros' must be a map with the key 'distro', such as {distro: " +
                                     distro_names.back() + "}, not " + what_is(entry.value));
    return std::nullopt;
  }
  std::optional<RosDistro> distro;
  bool named = false;
  for (const Entry& element : entries_of(entry.value, "ros", problems)) {
    if (element.key != "distro") {
      problems.add(element.key_at, "unknown key '" + element.key + "' of ros" +
                                       suggestion(element.key, {"distro"}));
      continue;
    }
    named = true;
    const auto name = read_choice(element, "distribution of ROS 2", distro_names, problems);
    if (name) {
      distro =
          static_cast<RosDistro>(std::ranges::find(distro_names, *name) - distro_names.begin());
    }
  }
  if (!named) {
    problems.add(entry.key_at,
                 "ros has no distribution; add distro: NAME (what ROS_DISTRO says where ROS 2 "
                 "runs)");
  }
  return distro;
}

}  // namespace quoin
