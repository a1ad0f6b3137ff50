// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/runtime/dds/interfaces.hpp"

#include <algorithm>
#include <arpa/inet.h>
#include <array>
#include <cerrno>
#include <cstdint>
#include <ifaddrs.h>
#include <memory>
#include <net/if.h>
#include <netinet/in.h>
#include <optional>
#include <stdexcept>
#include <system_error>
#include <unistd.h>

namespace quoin::runtime {

namespace {

/// In the byte order of this machine.
std::optional<std::uint32_t> number_of(const std::string& address) {
  in_addr parsed{};
  if (::inet_pton(AF_INET, address.c_str(), &parsed) != 1) return std::nullopt;
  return ntohl(parsed.s_addr);
}

/// Whether `entry` of a deployment stands for the interface, its address or its network.
bool stands_for(const std::string& entry, const InterfaceAddress& candidate) {
  if (entry == candidate.interface || entry == candidate.address) return true;
  const std::size_t slash = entry.find('/');
  if (slash == std::string::npos) return false;
  const auto network = number_of(entry.substr(0, slash));
  const auto address = number_of(candidate.address);
  const int bits = std::stoi(entry.substr(slash + 1));
  if (!network || !address || bits < 0 || bits > 32) return false;
  return bits == 0 || (*network ^ *address) >> (32 - bits) == 0;
}

std::string joined(const std::vector<std::string>& texts) {
  std::string all;
  for (const std::string& text : texts) all += (all.empty() ? "" : ", ") + text;
  return all;
}

std::string text_of(const std::vector<InterfaceAddress>& host) {
  std::vector<std::string> texts;
  for (const InterfaceAddress& one : host)
    texts.push_back(one.interface + " (" + one.address + ")");
  return joined(texts);
}

}  // namespace

std::vector<InterfaceAddress> host_addresses() {
  ifaddrs* first = nullptr;
  if (::getifaddrs(&first) != 0) {
    throw std::system_error(errno, std::generic_category(), "getifaddrs");
  }
  const std::unique_ptr<ifaddrs, decltype(&::freeifaddrs)> all(first, &::freeifaddrs);
  std::vector<InterfaceAddress> addresses;
  for (const ifaddrs* one = first; one != nullptr; one = one->ifa_next) {
    if (one->ifa_addr == nullptr || one->ifa_addr->sa_family != AF_INET) continue;
    std::array<char, INET_ADDRSTRLEN> text{};
    const auto* address = reinterpret_cast<const sockaddr_in*>(one->ifa_addr);
    if (::inet_ntop(AF_INET, &address->sin_addr, text.data(), text.size()) == nullptr) continue;
    const std::string name = one->ifa_name;
    // A further address may have a label such as eth0:1.
    addresses.push_back({name.substr(0, name.find(':')), text.data(),
                         (one->ifa_flags & IFF_UP) != 0 && (one->ifa_flags & IFF_RUNNING) != 0});
  }
  return addresses;
}

std::string host_name() {
  std::array<char, 256> name{};
  return ::gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "unknown";
}

std::vector<InterfaceAddress> named_interfaces(const std::vector<std::string>& interfaces,
                                               const std::vector<InterfaceAddress>& host) {
  std::vector<InterfaceAddress> named;
  for (const InterfaceAddress& candidate : host) {
    if (std::any_of(interfaces.begin(), interfaces.end(),
                    [&](const std::string& entry) { return stands_for(entry, candidate); })) {
      named.push_back(candidate);
    }
  }
  return named;
}

std::vector<std::string> resolve_interfaces(const std::vector<std::string>& interfaces,
                                            const std::vector<InterfaceAddress>& host) {
  if (interfaces.empty()) return {"127.0.0.1"};
  const std::vector<InterfaceAddress> named = named_interfaces(interfaces, host);
  if (named.empty()) {
    // Not an error of the file: it may be right for others, and here a little later.
    throw std::runtime_error("this host has none of the interfaces " + joined(interfaces) +
                             "; it has " + (host.empty() ? "no IPv4 address" : text_of(host)) +
                             "; correct 'interfaces' of the network, or give it an address there");
  }
  std::vector<std::string> addresses;
  for (const InterfaceAddress& candidate : named) {
    if (candidate.running) addresses.push_back(candidate.address);
  }
  if (addresses.empty()) {
    throw std::runtime_error("no link on " + text_of(named) +
                             "; is the cable plugged in, and the interface up (ip link)?");
  }
  return addresses;
}

std::vector<std::size_t> servers_here(const NetworkConfig& network,
                                      const std::vector<std::string>& addresses) {
  std::vector<std::size_t> indexes;
  for (std::size_t i = 0; i < network.servers.size(); ++i) {
    const std::string& address = network.servers[i].address;
    if (std::find(addresses.begin(), addresses.end(), address) != addresses.end()) {
      indexes.push_back(i);
    }
  }
  return indexes;
}

}  // namespace quoin::runtime
