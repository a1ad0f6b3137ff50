// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "sensor_bridge/recordings/scan_json.hpp"

#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "sensor_bridge/excerpt.hpp"
#include "sensor_bridge/number.hpp"
#include "sensor_bridge/recordings/json_text.hpp"

namespace quoin::sensor_bridge {
namespace {

class ScanJson final : public ScanReader {
 public:
  ScanJson(const std::filesystem::path& file, const ScanGeometry& geometry)
      : lines_(file), text_(lines_), geometry_(geometry) {}

  bool next(RecordedScan& scan) override {
    if (first_) {
      text_.expect('{');
      if (text_.string() != "map") text_.fail("the file begins with the key \"map\", not another");
      text_.expect(':');
      text_.expect('{');
    }
    if (ended_ || text_.skip('}')) {
      ended_ = true;
      return false;
    }
    if (!first_) text_.expect(',');
    first_ = false;
    scan.clear();
    const std::string_view stamp = text_.string();
    scan.stamp = parse_number<double>(stamp);
    if (!scan.stamp || !std::isfinite(*scan.stamp)) {
      text_.fail(excerpt(stamp) + " is not a time stamp");
    }
    text_.expect(':');
    read_scan(scan);
    return true;
  }

  [[noreturn]] void fail(const std::string& what) const override { text_.fail(what); }

 private:
  void read_scan(RecordedScan& scan) {
    std::optional<double> x, y, theta;
    text_.expect('{');
    do {
      const std::string_view key = text_.string();
      std::optional<double>* const value = key == "x"       ? &x
                                           : key == "y"     ? &y
                                           : key == "theta" ? &theta
                                                            : nullptr;
      const bool ranges = key == "range";
      text_.expect(':');
      if (value != nullptr) {
        *value = text_.number();
      } else if (ranges) {
        read_ranges(scan);
      } else {
        text_.skip_value();
      }
    } while (text_.skip(','));
    text_.expect('}');
    if (scan.ranges.empty()) text_.fail("a scan without ranges before here");
    std::string note = fill_bearings(scan.ranges.size(), geometry_, scan.bearings);
    if (!note.empty()) scan.notes.push_back(std::move(note));
    if (x && y && theta && std::isfinite(*x + *y + *theta)) {
      scan.odometry.push_back({std::nullopt, {*x, *y, *theta}});
    }
  }

  void read_ranges(RecordedScan& scan) {
    scan.ranges.clear();
    text_.expect('[');
    if (text_.skip(']')) return;
    do {
      if (scan.ranges.size() == RecordedScan::max_points) {
        text_.fail("more than " + std::to_string(RecordedScan::max_points) +
                   " ranges; the file is damaged here");
      }
      scan.ranges.push_back(static_cast<float>(text_.number()));
    } while (text_.skip(','));
    text_.expect(']');
  }

  LineReader lines_;
  JsonText text_;
  ScanGeometry geometry_;
  bool first_ = true;
  bool ended_ = false;
};

}  // namespace

std::unique_ptr<ScanReader> open_scan_json(const std::filesystem::path& file,
                                           const ScanGeometry& geometry) {
  return std::make_unique<ScanJson>(file, geometry);
}

}  // namespace quoin::sensor_bridge
