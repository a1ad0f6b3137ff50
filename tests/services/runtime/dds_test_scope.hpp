// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <unistd.h>

namespace quoin::tests {

/// DDS domain of this test process. Tests run in parallel, each case in a process of its own;
/// should two share a domain, the topic prefix still keeps them apart.
inline int test_domain() { return 20 + static_cast<int>(getpid() % 200); }

/// Topic prefix that no other test process uses.
inline std::string test_namespace() { return "test_" + std::to_string(getpid()); }

}  // namespace quoin::tests
