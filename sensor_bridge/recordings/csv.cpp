// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "sensor_bridge/recordings/csv.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <utility>
#include <vector>

#include "sensor_bridge/excerpt.hpp"
#include "sensor_bridge/number.hpp"
#include "sensor_bridge/recordings/csv_columns.hpp"
#include "sensor_bridge/recordings/revolution_split.hpp"

namespace quoin::sensor_bridge {
namespace {

// Rays that a guess is made of: a revolution of most sensors.
constexpr std::size_t rows_to_guess_by = 400;
// Some drivers count bearings from 0 to 2 pi, some go on a little beyond.
constexpr double largest_bearing = 4.0 * std::numbers::pi + 1e-6;  // [rad]

class CsvScans final : public ScanReader {
 public:
  CsvScans(const std::filesystem::path& file, const std::string& columns)
      : lines_(file), columns_(columns) {}

  bool next(RecordedScan& scan) override {
    if (!begun_) begin();
    scan.clear();
    if (!note_.empty()) scan.notes.push_back(std::exchange(note_, ""));
    if (only_names_) {
      only_names_ = false;
      return true;
    }
    return read_revolution(scan);
  }

  [[noreturn]] void fail(const std::string& what) const override { lines_.fail(0, what); }

 private:
  struct Row {
    std::vector<double> values;
  };

  /// Finds out how the file is written.
  void begin() {
    begun_ = true;
    std::string_view line;
    if (!next_line(line)) return;
    try {
      if (!columns_.empty()) layout_ = layout_of_names(columns_);
    } catch (const std::invalid_argument& error) {
      throw ScanFileError("columns: '" + columns_ + "': " + error.what());
    }
    layout_.separator = separator_of(line);
    const std::vector<std::string_view> first = split_columns(line, layout_.separator);
    const bool names = std::ranges::none_of(
        first, [](std::string_view part) { return parse_number<double>(part).has_value(); });
    if (names) {
      try {
        if (columns_.empty()) {
          const char separator = layout_.separator;
          layout_ = layout_of_names(line);
          layout_.separator = separator;
        }
      } catch (const std::invalid_argument& error) {
        lines_.fail(0, error.what());
      }
      if (!next_line(line)) {
        only_names_ = true;
        return;
      }
      layout_.separator = separator_of(line);
    }
    do {
      rows_.push_back({values_of(line)});
    } while (rows_.size() < rows_to_guess_by && next_line(line));
    std::vector<std::vector<double>> rows;
    for (const Row& row : rows_) rows.push_back(row.values);
    try {
      note_ = guess_layout(rows, layout_);
    } catch (const std::invalid_argument& error) {
      lines_.fail(0, error.what());
    }
    if (!note_.empty()) note_ += " (columns: tells otherwise)";
  }

  bool next_line(std::string_view& line) {
    while (lines_.next(line)) {
      const std::size_t content = line.find_first_not_of(" \t");
      if (content != std::string_view::npos && line[content] != '#') return true;
    }
    return false;
  }

  std::vector<double> values_of(std::string_view line) {
    const std::vector<std::string_view> parts = split_columns(line, layout_.separator);
    const std::size_t expected =
        !layout_.columns.empty() ? layout_.columns.size() : count_.value_or(parts.size());
    count_ = expected;
    if (parts.size() != expected) {
      lines_.fail(0, "a line of " + std::to_string(parts.size()) + " columns; the others have " +
                         std::to_string(expected));
    }
    std::vector<double> values;
    for (std::size_t i = 0; i < parts.size(); ++i) {
      const std::optional<double> value = parse_number<double>(parts[i]);
      const bool needed = layout_.columns.empty() || layout_.columns[i].role != ColumnRole::ignored;
      if (!value && needed) {
        lines_.fail(static_cast<std::size_t>(parts[i].data() - line.data()),
                    excerpt(parts[i]) + " is not a number");
      }
      values.push_back(value.value_or(0.0));
    }
    return values;
  }

  std::optional<Row> next_row() {
    if (!rows_.empty()) {
      Row row = std::move(rows_.front());
      rows_.pop_front();
      return row;
    }
    std::string_view line;
    if (!next_line(line)) return std::nullopt;
    return Row{values_of(line)};
  }

  [[nodiscard]] std::optional<double> value(const Row& row, ColumnRole role) const {
    const auto column = layout_.find(role);
    if (!column) return std::nullopt;
    return row.values[*column] * layout_.columns[*column].to_si;
  }

  bool read_revolution(RecordedScan& scan) {
    RevolutionSplit split;
    std::optional<double> revolution;
    while (true) {
      std::optional<Row> row = held_ ? std::exchange(held_, std::nullopt) : next_row();
      if (!row) break;
      const auto [bearing, range] = ray_of(*row);
      const std::optional<double> number = value(*row, ColumnRole::revolution);
      const bool next_number = revolution && number && *number != *revolution;
      if (!scan.ranges.empty() && (next_number || (!number && split.begins_anew(bearing)))) {
        held_ = std::move(row);
        if (next_number || !is_rest(scan)) return true;
        row = std::exchange(held_, std::nullopt);
      }
      revolution = number;
      split.add(bearing);
      if (scan.ranges.size() == RecordedScan::max_points) {
        lines_.fail(0, "more than " + std::to_string(RecordedScan::max_points) +
                           " rays that never come round; are the columns right?");
      }
      if (scan.ranges.empty()) scan.stamp = value(*row, ColumnRole::time);
      scan.bearings.push_back(static_cast<float>(bearing));
      scan.ranges.push_back(static_cast<float>(range));
      if (const auto quality = value(*row, ColumnRole::quality)) {
        scan.qualities.push_back(static_cast<float>(*quality));
      }
    }
    return !scan.ranges.empty();
  }

  /// Whether what is held is the end of this revolution: some sensors write both 0 and 2 pi.
  bool is_rest(const RecordedScan& scan) {
    constexpr std::size_t fewest = 3;
    if (scan.ranges.size() < fewest) return true;
    std::vector<Row> ahead;
    while (ahead.size() + 1 < fewest) {
      std::optional<Row> row = next_row();
      if (!row) break;
      ahead.push_back(std::move(*row));
    }
    const bool rest = ahead.size() + 1 < fewest;
    for (auto row = ahead.rbegin(); row != ahead.rend(); ++row) rows_.push_front(std::move(*row));
    return rest;
  }

  std::pair<double, double> ray_of(const Row& row) const {
    if (const auto bearing = value(row, ColumnRole::bearing)) {
      if (!(std::abs(*bearing) <= largest_bearing)) {
        lines_.fail(0,
                    "a bearing beyond two turns; 'columns' says what the columns hold and in "
                    "which units, such as angle_deg,distance_mm");
      }
      return {*bearing, value(row, ColumnRole::range).value_or(0.0)};
    }
    const double x = value(row, ColumnRole::x).value_or(0.0);
    const double y = value(row, ColumnRole::y).value_or(0.0);
    return {std::atan2(y, x), std::hypot(x, y)};
  }

  LineReader lines_;
  std::string columns_;
  bool begun_ = false;
  bool only_names_ = false;
  CsvLayout layout_;
  std::optional<std::size_t> count_;
  std::deque<Row> rows_;     // that were read ahead
  std::optional<Row> held_;  // first ray of the next revolution
  std::string note_;
};

}  // namespace

std::unique_ptr<ScanReader> open_csv_scans(const std::filesystem::path& file,
                                           const std::string& columns) {
  return std::make_unique<CsvScans>(file, columns);
}

}  // namespace quoin::sensor_bridge
