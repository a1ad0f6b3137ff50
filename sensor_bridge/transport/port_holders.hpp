// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace quoin::sensor_bridge {

/// A program that has a port open.
struct PortHolder {
  int process = 0;
  std::string name;  ///< as the system shortens it

  friend bool operator==(const PortHolder&, const PortHolder&) = default;
};

/// The processes that have the file open, as far as this user may see. `root` is the root of the
/// file system.
[[nodiscard]] std::vector<PortHolder> holders_of(const std::filesystem::path& port,
                                                 const std::filesystem::path& root = "/");

/// "process 4711 (ModemManager)".
[[nodiscard]] std::string to_text(const PortHolder& holder);

}  // namespace quoin::sensor_bridge
