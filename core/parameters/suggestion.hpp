// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace quoin {

/// The candidate nearest to `name` by edit distance (a swap of neighbours counts once), or "" when
/// none is near enough to be what was meant.
[[nodiscard]] std::string nearest_name(std::string_view name,
                                       const std::vector<std::string>& candidates);

/// "; did you mean 'x'?" when some candidate is near, else "; known are a, b, c".
[[nodiscard]] std::string suggestion(std::string_view name,
                                     const std::vector<std::string>& candidates);

}  // namespace quoin
