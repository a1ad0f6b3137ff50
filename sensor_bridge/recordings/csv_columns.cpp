// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "sensor_bridge/recordings/csv_columns.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "sensor_bridge/recordings/scan_geometry.hpp"

namespace quoin::sensor_bridge {

namespace {

struct Word {
  std::string_view text;
  ColumnRole role;
};
// Beginnings of names, in the order in which they are tried.
constexpr std::array words{
    Word{"angle", ColumnRole::bearing},    Word{"bearing", ColumnRole::bearing},
    Word{"theta", ColumnRole::bearing},    Word{"azimuth", ColumnRole::bearing},
    Word{"phi", ColumnRole::bearing},      Word{"alpha", ColumnRole::bearing},
    Word{"heading", ColumnRole::bearing},  Word{"range", ColumnRole::range},
    Word{"dist", ColumnRole::range},       Word{"radius", ColumnRole::range},
    Word{"depth", ColumnRole::range},      Word{"rho", ColumnRole::range},
    Word{"quality", ColumnRole::quality},  Word{"intensity", ColumnRole::quality},
    Word{"strength", ColumnRole::quality}, Word{"confidence", ColumnRole::quality},
    Word{"scan", ColumnRole::revolution},  Word{"rev", ColumnRole::revolution},
    Word{"sweep", ColumnRole::revolution}, Word{"frame", ColumnRole::revolution},
    Word{"time", ColumnRole::time},        Word{"stamp", ColumnRole::time}};

struct UnitName {
  std::string_view text;
  ColumnRole role;
  double to_si;
};
constexpr std::array unit_names{UnitName{"degrees", ColumnRole::bearing, degree},
                                UnitName{"deg", ColumnRole::bearing, degree},
                                UnitName{"radians", ColumnRole::bearing, 1.0},
                                UnitName{"rad", ColumnRole::bearing, 1.0},
                                UnitName{"mm", ColumnRole::range, 1e-3},
                                UnitName{"cm", ColumnRole::range, 1e-2},
                                UnitName{"meters", ColumnRole::range, 1.0},
                                UnitName{"metres", ColumnRole::range, 1.0},
                                UnitName{"m", ColumnRole::range, 1.0},
                                UnitName{"ns", ColumnRole::time, 1e-9},
                                UnitName{"us", ColumnRole::time, 1e-6},
                                UnitName{"ms", ColumnRole::time, 1e-3},
                                UnitName{"s", ColumnRole::time, 1.0}};

std::string lower(std::string_view text) {
  std::string result;
  for (const char c : text)
    result += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return result;
}

/// The parts of a name between anything that is neither letter nor digit.
std::vector<std::string> parts_of(std::string_view name) {
  std::vector<std::string> parts(1);
  for (const char c : lower(name)) {
    if (std::isalnum(static_cast<unsigned char>(c)) != 0) {
      parts.back() += c;
    } else if (!parts.back().empty()) {
      parts.emplace_back();
    }
  }
  if (parts.back().empty()) parts.pop_back();
  return parts;
}

/// Share of steps from row to row that go the way of most.
struct Course {
  double one_way = 0.0;
  double span = 0.0;
};
Course course_of(const std::vector<std::vector<double>>& rows, std::size_t column) {
  std::size_t up = 0;
  std::size_t down = 0;
  double least = rows[0][column];
  double most = least;
  for (std::size_t i = 1; i < rows.size(); ++i) {
    const double step = rows[i][column] - rows[i - 1][column];
    up += step > 0.0 ? 1 : 0;
    down += step < 0.0 ? 1 : 0;
    least = std::min(least, rows[i][column]);
    most = std::max(most, rows[i][column]);
  }
  const auto steps = static_cast<double>(std::max<std::size_t>(rows.size() - 1, 1));
  return {static_cast<double>(std::max(up, down)) / steps, most - least};
}

double largest(const std::vector<std::vector<double>>& rows, std::size_t column) {
  double most = 0.0;
  for (const auto& row : rows) {
    if (std::isfinite(row[column])) most = std::max(most, std::abs(row[column]));
  }
  return most;
}

/// Which columns are bearing and range, where nothing says so. The bearing climbs or falls evenly.
std::string guess_roles(const std::vector<std::vector<double>>& rows, CsvLayout& layout) {
  const std::size_t columns = rows[0].size();
  layout.columns.assign(columns, {ColumnRole::ignored, 0.0});
  if (columns < 2 || columns > 3) {
    throw std::invalid_argument(
        std::to_string(columns) +
        " columns without names; say what they hold with 'columns', such as "
        "angle_deg,distance_mm");
  }
  constexpr double mostly = 0.9;
  std::optional<std::size_t> bearing;
  for (std::size_t i = 0; i < columns && !bearing; ++i) {
    const Course course = course_of(rows, i);
    if (course.one_way >= mostly && course.span <= 760.0) bearing = i;
  }
  if (!bearing && rows.size() >= 8) {
    throw std::invalid_argument(
        "no column climbs or falls evenly, as bearings do; say what they hold with 'columns', such "
        "as x,y or bearing,range");
  }
  const std::size_t angle = bearing.value_or(0);  // too few rays to tell: bearing, range
  // Of (quality, angle, distance) the quality is the first, of (angle, distance, quality) the last.
  const std::size_t range = columns == 2 ? 1 - angle : angle == 2 ? 1 : angle + 1;
  layout.columns[angle].role = ColumnRole::bearing;
  layout.columns[range].role = ColumnRole::range;
  if (columns == 3) layout.columns[3 - angle - range] = {ColumnRole::quality, 1.0};
  if (columns == 2 && angle == 0) return "";
  return "column " + std::to_string(angle + 1) + " is taken for the bearing, column " +
         std::to_string(range + 1) + " for the range";
}

}  // namespace

std::optional<std::size_t> CsvLayout::find(ColumnRole role) const {
  const auto found = std::ranges::find(columns, role, &CsvColumn::role);
  if (found == columns.end()) return std::nullopt;
  return static_cast<std::size_t>(found - columns.begin());
}

char separator_of(std::string_view line) {
  for (const char separator : {';', ',', '\t'}) {
    if (line.find(separator) != std::string_view::npos) return separator;
  }
  return ' ';
}

std::vector<std::string_view> split_columns(std::string_view line, char separator) {
  constexpr std::string_view blank = " \t";
  std::vector<std::string_view> parts;
  std::size_t begin = 0;
  while (begin <= line.size()) {
    if (separator == ' ') {
      begin = line.find_first_not_of(blank, begin);
      if (begin == std::string_view::npos) break;
    }
    const std::size_t end = separator == ' '
                                ? std::min(line.find_first_of(blank, begin), line.size())
                                : std::min(line.find(separator, begin), line.size());
    std::string_view part = line.substr(begin, end - begin);
    while (part.starts_with(' ') || part.starts_with('\t')) part.remove_prefix(1);
    while (part.ends_with(' ') || part.ends_with('\t')) part.remove_suffix(1);
    if (part.size() > 1 && part.starts_with('"') && part.ends_with('"')) {
      part = part.substr(1, part.size() - 2);
    }
    parts.push_back(part);
    begin = end + 1;
  }
  // A separator behind the last value.
  if (parts.size() > 1 && parts.back().empty()) parts.pop_back();
  return parts;
}

CsvColumn column_of(std::string_view name) {
  const std::vector<std::string> parts = parts_of(name);
  if (parts.empty()) return {};
  CsvColumn column{ColumnRole::ignored, 0.0};
  const std::string& first = parts.front();
  if (first == "x") column.role = ColumnRole::x;
  if (first == "y") column.role = ColumnRole::y;
  if (first == "r") column.role = ColumnRole::range;
  if (first == "t") column.role = ColumnRole::time;
  for (const Word& word : words) {
    if (column.role != ColumnRole::ignored) break;
    for (const std::string& part : parts) {
      if (part.starts_with(word.text)) column.role = word.role;
    }
  }
  const ColumnRole unit_role = column.role == ColumnRole::x || column.role == ColumnRole::y
                                   ? ColumnRole::range
                                   : column.role;
  for (std::size_t i = parts.size(); i > 0 && column.to_si == 0.0; --i) {
    for (const UnitName& unit : unit_names) {
      if (unit.role == unit_role && parts[i - 1] == unit.text) column.to_si = unit.to_si;
    }
  }
  if (column.to_si == 0.0 &&
      (column.role == ColumnRole::quality || column.role == ColumnRole::revolution)) {
    column.to_si = 1.0;
  }
  return column;
}

CsvLayout layout_of_names(std::string_view line) {
  CsvLayout layout;
  layout.separator = separator_of(line);
  for (const std::string_view name : split_columns(line, layout.separator)) {
    layout.columns.push_back(column_of(name));
  }
  const bool polar = layout.find(ColumnRole::bearing) && layout.find(ColumnRole::range);
  const bool cartesian = layout.find(ColumnRole::x) && layout.find(ColumnRole::y);
  if (!polar && !cartesian) {
    throw std::invalid_argument(
        "these names have neither a bearing and a range nor x and y; say what the columns hold "
        "with "
        "'columns', such as angle_deg,distance_mm");
  }
  return layout;
}

std::string guess_layout(const std::vector<std::vector<double>>& rows, CsvLayout& layout) {
  if (rows.empty()) return "";
  std::string guessed;
  if (layout.columns.empty()) guessed = guess_roles(rows, layout);
  const auto say = [&](const std::string& text) {
    guessed += (guessed.empty() ? "" : "; ") + text;
  };
  const auto complete = [&](ColumnRole role, double limit, double beyond, const char* what,
                            const char* usual, const char* other) {
    const auto column = layout.find(role);
    if (!column || layout.columns[*column].to_si != 0.0) return;
    const bool large = largest(rows, *column) > limit;
    layout.columns[*column].to_si = large ? beyond : 1.0;
    if (large) say(std::string(what) + " are taken for " + other + ", not " + usual);
  };
  // No sensor turns more than two times in a revolution, or sees as far as 200 m but says so.
  complete(ColumnRole::bearing, 4.0 * std::numbers::pi, degree, "bearings", "radians", "degrees");
  complete(ColumnRole::range, 200.0, 1e-3, "ranges", "metres", "millimetres");
  complete(ColumnRole::x, 200.0, 1e-3, "x", "metres", "millimetres");
  complete(ColumnRole::y, 200.0, 1e-3, "y", "metres", "millimetres");
  if (const auto time = layout.find(ColumnRole::time); time && layout.columns[*time].to_si == 0.0) {
    const double most = largest(rows, *time);
    layout.columns[*time].to_si = most > 1e17   ? 1e-9
                                  : most > 1e14 ? 1e-6
                                  : most > 1e11 ? 1e-3
                                                : 1.0;
  }
  return guessed;
}

}  // namespace quoin::sensor_bridge
