// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace quoin::sensor_bridge {

/// What a column of a table of rays holds.
enum class ColumnRole { bearing, range, quality, x, y, revolution, time, ignored };

struct CsvColumn {
  ColumnRole role = ColumnRole::ignored;
  double to_si = 1.0;  ///< factor to rad, m or s; 0: not said
};

/// How a table of rays is written.
struct CsvLayout {
  char separator = ',';  ///< ' ': blanks of any number
  std::vector<CsvColumn> columns;

  [[nodiscard]] std::optional<std::size_t> find(ColumnRole role) const;
};

/// The separator of a line: comma, semicolon, tab or blanks, whichever it has.
[[nodiscard]] char separator_of(std::string_view line);
[[nodiscard]] std::vector<std::string_view> split_columns(std::string_view line, char separator);

/// A column by its name, such as "angle_deg", "distance (mm)", "theta", "x [m]" or "quality".
[[nodiscard]] CsvColumn column_of(std::string_view name);

/// The layout that a line of names describes. Throws std::invalid_argument when it does not name a
/// bearing and a range, or x and y.
[[nodiscard]] CsvLayout layout_of_names(std::string_view line);

/// Completes `layout` by the values of the first rays: which columns they are where no name says
/// so, and units that are not said. Returns what was guessed, for people; "" when nothing was.
/// Throws std::invalid_argument when the values do not look like rays.
[[nodiscard]] std::string guess_layout(const std::vector<std::vector<double>>& rows,
                                       CsvLayout& layout);

}  // namespace quoin::sensor_bridge
