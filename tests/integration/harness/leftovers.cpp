// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/integration/harness/leftovers.hpp"

#include <filesystem>
#include <fstream>
#include <sstream>

namespace quoin::tests {

std::set<pid_t> processes_naming(const std::string& text) {
  std::set<pid_t> found;
  for (const auto& entry : std::filesystem::directory_iterator("/proc")) {
    const std::string name = entry.path().filename();
    if (name.find_first_not_of("0123456789") != std::string::npos) continue;
    // Reading fails when the process ends meanwhile; an iterator over the buffer would throw then.
    std::ostringstream command;
    command << std::ifstream(entry.path() / "cmdline").rdbuf();
    if (command.str().find(text) != std::string::npos)
      found.insert(static_cast<pid_t>(std::stol(name)));
  }
  return found;
}

std::set<std::string> shared_memory_files() {
  std::set<std::string> files;
  for (const auto& entry : std::filesystem::directory_iterator("/dev/shm")) {
    files.insert(entry.path().filename());
  }
  return files;
}

std::set<int> bound_ports(int domain) {
  constexpr int base = 7400;
  constexpr int ports_of_a_domain = 250;
  const int first = base + ports_of_a_domain * domain;
  std::set<int> ports;
  std::ifstream table("/proc/net/udp");
  std::string line;
  std::getline(table, line);  // the heading
  while (std::getline(table, line)) {
    // "  sl  local_address ...": a number, then ADDRESS:PORT in hexadecimal digits
    const std::size_t colon = line.find(':', line.find(':') + 1);
    if (colon == std::string::npos) continue;
    const int port = std::stoi(line.substr(colon + 1, 4), nullptr, 16);
    if (port >= first && port < first + ports_of_a_domain) ports.insert(port);
  }
  return ports;
}

}  // namespace quoin::tests
