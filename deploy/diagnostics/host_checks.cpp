// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "deploy/diagnostics/host_checks.hpp"

#include <arpa/inet.h>
#include <fstream>
#include <net/if.h>
#include <optional>
#include <set>
#include <sstream>
#include <unistd.h>

#include "deploy/kinds/kinds.hpp"
#include "deploy/observation/table.hpp"

namespace quoin::deploy {

namespace {

namespace fs = std::filesystem;

constexpr double mebibyte = 1024.0 * 1024.0;
// By which participants announce themselves, of all the RTPS standard's addresses.
constexpr const char* announcement_address = "239.255.0.1";

std::optional<std::uint64_t> read_number(const fs::path& file,
                                         std::ios_base& (*base)(std::ios_base&)) {
  std::ifstream stream(file);
  std::uint64_t number = 0;
  if (!(stream >> base >> number)) return std::nullopt;
  return number;
}

std::string joined(const std::vector<std::string>& texts) {
  std::string result;
  for (const std::string& text : texts) result += (result.empty() ? "" : ", ") + text;
  return result;
}

/// Whether the kernel's table has a way to `address`; its numbers are in the order of the network.
bool has_route(const fs::path& table, const std::string& address) {
  in_addr wanted{};
  ::inet_pton(AF_INET, address.c_str(), &wanted);
  std::ifstream stream(table);
  std::string line;
  std::getline(stream, line);  // the names of the columns
  while (std::getline(stream, line)) {
    std::istringstream columns(line);
    std::string interface, skipped;
    std::uint32_t destination = 0;
    std::uint32_t mask = 0;
    columns >> interface >> std::hex >> destination >> skipped >> skipped >> skipped >> skipped >>
        skipped >> mask;
    if (columns && (wanted.s_addr & mask) == destination) return true;
  }
  return false;
}

Check check_interface(const NamedInterface& interface, bool multicast,
                      const fs::path& interface_folder) {
  const std::string what = interface.name + " (" + interface.address + ")";
  if (!interface.running) {
    return {"network", Verdict::bad, what + " is down or has no link: other hosts are not reached",
            "plug the cable in, or: ip link set " + interface.name + " up"};
  }
  const auto flags = read_number(interface_folder / interface.name / "flags", std::hex);
  if (multicast && flags && (*flags & IFF_MULTICAST) == 0) {
    return {"network", Verdict::bad,
            what + " has no multicast: participants do not find each other by it",
            "ip link set " + interface.name + " multicast on, or discovery: peers"};
  }
  return {"network", Verdict::good, what + (multicast ? ", with multicast" : ""), ""};
}

Check untold(const std::string& name) {
  return {name, Verdict::good, "not told in this container; see the host", ""};
}

/// How to give the kernel these settings, each "name=value".
std::string sysctl(const std::vector<std::string>& settings) {
  std::string advice = "sysctl -w";
  for (const std::string& setting : settings) advice += " " + setting;
  return advice + " (as root; a file in /etc/sysctl.d keeps it)";
}

}  // namespace

Check check_socket_buffers(const fs::path& folder, std::uint64_t wanted) {
  const std::string name = "socket buffers";
  std::vector<std::string> small, settings;
  bool known = false;
  for (const char* limit : {"rmem_max", "wmem_max"}) {
    const auto bytes = read_number(folder / limit, std::dec);
    known = known || bytes;
    if (!bytes || *bytes >= wanted) continue;
    small.push_back(std::string("net.core.") + limit + " is " + std::to_string(*bytes));
    settings.push_back(std::string("net.core.") + limit + "=" + std::to_string(wanted));
  }
  if (!known) return untold(name);
  if (small.empty()) return {name, Verdict::good, "as large as wanted", ""};
  return {name, Verdict::doubtful,
          joined(small) + ", less than the " + std::to_string(wanted) +
              " bytes that participants ask for: a burst of scans can overflow them",
          sysctl(settings)};
}

Check check_reassembly(const fs::path& folder) {
  constexpr std::uint64_t wanted = 3;  // [s] what is repeated comes much earlier
  const std::string name = "lost packets";
  const auto seconds = read_number(folder / "ipfrag_time", std::dec);
  if (!seconds) return untold(name);
  if (*seconds <= wanted) return {name, Verdict::good, "soon forgotten", ""};
  return {name, Verdict::doubtful,
          "net.ipv4.ipfrag_time is " + std::to_string(*seconds) +
              ": on a link that loses packets no scan may arrive for that many seconds",
          sysctl({"net.ipv4.ipfrag_time=" + std::to_string(wanted)})};
}

Checks check_network(const NetworkConfig& network, const std::vector<NamedInterface>& interfaces,
                     const fs::path& interface_folder, const fs::path& routes) {
  if (network.interfaces.empty()) {
    return {{"network", Verdict::good, "127.0.0.1 alone, as no interface is named", ""}};
  }
  if (interfaces.empty()) {
    return {{"network", Verdict::bad,
             "this host has none of " + joined(network.interfaces) + ": no service can start here",
             "name one that ip address shows under interfaces: of network: in the deployment"}};
  }
  const bool multicast = network.discovery == Discovery::multicast;
  Checks checks;
  for (const NamedInterface& interface : interfaces) {
    checks.push_back(check_interface(interface, multicast, interface_folder));
  }
  if (multicast && !has_route(routes, announcement_address)) {
    checks.push_back(
        {"network", Verdict::doubtful,
         std::string("there is no route to ") + announcement_address +
             ": other DDS programs on this host may not be able to announce themselves",
         "ip route add 224.0.0.0/4 dev " + interfaces.front().name});
  }
  return checks;
}

Check check_disk(const fs::path& folder, std::uint64_t capacity, std::uint64_t available) {
  const double share =
      capacity == 0 ? 1.0 : static_cast<double>(available) / static_cast<double>(capacity);
  const double room = static_cast<double>(available) / mebibyte;
  const std::string text =
      folder.string() + " has " + fixed(room, 0) + " MiB left, " + fixed(100.0 * share, 0) + " %";
  if (room < 50.0) {
    return {"disk", Verdict::bad, text + ": logs, reports and recordings are cut off",
            "remove what is not needed (du -xh " + folder.string() + " | sort -h | tail)"};
  }
  if (share < 0.05 && room < 1024.0) {
    return {"disk", Verdict::doubtful, text + ": soon logs, reports and recordings are cut off",
            "make room (du -xh " + folder.string() + " | sort -h | tail)"};
  }
  return {"disk", Verdict::good, text, ""};
}

Check check_programs(const fs::path& folder) {
  std::set<std::string> missing;
  for (const KindInfo* kind : kinds().kinds) {
    if (kind->program.empty()) continue;
    const fs::path program = folder / kind->program;
    if (::access(program.c_str(), X_OK) != 0) missing.insert(program.filename());
  }
  if (missing.empty()) return {"programs", Verdict::good, "all are in " + folder.string(), ""};
  return {"programs", Verdict::bad,
          joined({missing.begin(), missing.end()}) + " missing in " + folder.string() +
              ": services of these kinds cannot start",
          "build or install all of Quoin, and call quoin from there"};
}

}  // namespace quoin::deploy
