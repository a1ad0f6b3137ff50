// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "deploy/observation/comparison_figures.hpp"

namespace quoin::deploy {

/// The figures as lines of a table of at most `width` characters, the reference first. Of pairs,
/// the first is the median; the second the 95th percentile of distances, the 99th of latencies.
[[nodiscard]] std::vector<std::string> table_lines(const ComparisonFigures& figures,
                                                   std::size_t width);

/// The same in one line, for logs.
[[nodiscard]] std::string progress_line(const ComparisonFigures& figures);

/// The figures as the JSON object that `quoin compare --json` ends with. The names in it are an
/// interface: they may be added to, not changed.
[[nodiscard]] nlohmann::ordered_json summary(const ComparisonFigures& figures);

}  // namespace quoin::deploy
