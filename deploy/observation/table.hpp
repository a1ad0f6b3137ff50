// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "deploy/observation/figures.hpp"

namespace quoin::deploy {

/// `value` with `digits` digits behind the point.
[[nodiscard]] std::string fixed(double value, int digits);

/// Two times or lengths in milliseconds or millimetres, "0.48 / 0.80"; "-" when there are none.
[[nodiscard]] std::string milli_pair(double first, double second);

/// Appends `rows` as lines of at most `width` characters, columns as wide as their widest cell; the
/// first `left` columns are aligned to the left. All rows have as many cells as the first.
void append_table(const std::vector<std::vector<std::string>>& rows, std::size_t left,
                  std::size_t width, std::vector<std::string>& lines);

/// The figures as lines of a table of at most `width` characters: the services, then what the
/// corner services delivered.
[[nodiscard]] std::vector<std::string> table_lines(const DeploymentFigures& figures,
                                                   std::size_t width);

/// What services report of themselves, wherever they run, as lines of a table.
[[nodiscard]] std::vector<std::string> status_lines(const std::vector<ServiceFigures>& services);

/// The figures of a deployment in one line, for logs: what arrives at the ends, or the services
/// while nothing does.
[[nodiscard]] std::string progress_line(const DeploymentFigures& figures);

}  // namespace quoin::deploy
