// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "sensor_bridge/transport/port_holders.hpp"

#include <algorithm>
#include <fstream>
#include <system_error>

#include "sensor_bridge/number.hpp"

namespace quoin::sensor_bridge {
namespace {

namespace fs = std::filesystem;

bool has_open(const fs::path& process, const fs::path& file) {
  std::error_code error;
  for (fs::directory_iterator entry(process / "fd", error), end; !error && entry != end;
       entry.increment(error)) {
    std::error_code unreadable;
    if (fs::read_symlink(entry->path(), unreadable) == file && !unreadable) return true;
  }
  return false;
}

}  // namespace

std::vector<PortHolder> holders_of(const fs::path& port, const fs::path& root) {
  std::vector<PortHolder> holders;
  std::error_code error;
  const fs::path file = fs::weakly_canonical(port, error);
  if (error) return holders;
  for (fs::directory_iterator entry(root / "proc", error), end; !error && entry != end;
       entry.increment(error)) {
    const auto process = parse_number<int>(entry->path().filename().native());
    if (!process || !has_open(entry->path(), file)) continue;
    PortHolder holder{.process = *process, .name = {}};
    std::ifstream(entry->path() / "comm") >> holder.name;
    holders.push_back(std::move(holder));
  }
  std::ranges::sort(holders, {}, &PortHolder::process);
  return holders;
}

std::string to_text(const PortHolder& holder) {
  return "process " + std::to_string(holder.process) +
         (holder.name.empty() ? "" : " (" + holder.name + ")");
}

}  // namespace quoin::sensor_bridge
