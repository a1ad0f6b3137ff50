// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "sensor_bridge/recordings/csv.hpp"

#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>

#include "sensor_bridge/excerpt.hpp"
#include "sensor_bridge/number.hpp"

namespace quoin::sensor_bridge {
namespace {

// Some drivers count bearings from 0 to 2 pi, some go on a little beyond; more than two turns are
// degrees by mistake.
constexpr double max_bearing = 4.0 * std::numbers::pi;  // [rad]

/// Part of a line with its position in it.
struct Column {
  std::string_view text;
  std::size_t offset = 0;
};

Column trimmed(std::string_view line, std::size_t begin, std::size_t end) {
  const auto is_blank = [&](std::size_t i) { return line[i] == ' ' || line[i] == '\t'; };
  while (begin < end && is_blank(begin)) ++begin;
  while (begin < end && is_blank(end - 1)) --end;
  return {line.substr(begin, end - begin), begin};
}

struct Row {
  Column bearing;
  Column range;
};

Row split(const LineReader& lines, std::string_view line) {
  const std::size_t comma = line.find(',');
  if (comma == std::string_view::npos) {
    lines.fail(line.size(), "a line is written 'bearing,range'; the comma is missing");
  }
  const std::size_t second = line.find(',', comma + 1);
  if (second != std::string_view::npos) {
    lines.fail(second, "a line is written 'bearing,range'; here is a third column");
  }
  return {trimmed(line, 0, comma), trimmed(line, comma + 1, line.size())};
}

double number(const LineReader& lines, const Column& column) {
  const std::optional<double> value = parse_number<double>(column.text);
  if (!value) lines.fail(column.offset, excerpt(column.text) + " is not a number");
  return *value;
}

bool is_header(const LineReader& lines, const Row& row) {
  if (parse_number<double>(row.bearing.text) || parse_number<double>(row.range.text)) return false;
  if (row.bearing.text.starts_with("range")) {
    lines.fail(row.bearing.offset, "the first column must be the bearing, the second the range");
  }
  return true;
}

}  // namespace

bool read_csv_scan(LineReader& lines, RecordedScan& scan) {
  scan.clear();
  bool header_possible = true;
  std::string_view line;
  while (lines.next(line)) {
    const Column content = trimmed(line, 0, line.size());
    if (content.text.empty() || content.text.starts_with('#')) continue;
    const Row row = split(lines, line);
    if (header_possible && is_header(lines, row)) {
      header_possible = false;
      continue;
    }
    header_possible = false;
    const double bearing = number(lines, row.bearing);
    const double range = number(lines, row.range);
    if (!(std::abs(bearing) <= max_bearing)) {
      lines.fail(row.bearing.offset, "bearing " + excerpt(row.bearing.text) +
                                         " is beyond two turns; bearings are in radians");
    }
    if (scan.bearings.size() == RecordedScan::max_points) {
      lines.fail(0, "more than " + std::to_string(RecordedScan::max_points) +
                        " rays; a file holds one revolution");
    }
    scan.bearings.push_back(static_cast<float>(bearing));
    scan.ranges.push_back(static_cast<float>(range));
  }
  return !scan.bearings.empty();
}

}  // namespace quoin::sensor_bridge
