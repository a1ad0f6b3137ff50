// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace quoin {

/// The governance document of DDS Security 1.1 for every domain: nobody joins, reads or writes
/// without permission, and messages are encrypted, or signed only.
[[nodiscard]] std::string governance_text(bool encrypt);

}  // namespace quoin
