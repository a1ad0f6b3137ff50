// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <set>
#include <string>
#include <sys/types.h>

namespace quoin::tests {

/// Processes whose command line has `text` in it.
[[nodiscard]] std::set<pid_t> processes_naming(const std::string& text);

/// Names of all files in /dev/shm.
[[nodiscard]] std::set<std::string> shared_memory_files();

/// UDP ports of a DDS domain that are bound on this host, by the port formula of the RTPS standard.
[[nodiscard]] std::set<int> bound_ports(int domain);

}  // namespace quoin::tests
