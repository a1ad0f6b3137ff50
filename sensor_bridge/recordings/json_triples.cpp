// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "sensor_bridge/recordings/json_triples.hpp"

#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <utility>

#include "sensor_bridge/recordings/json_text.hpp"
#include "sensor_bridge/recordings/revolution_split.hpp"

namespace quoin::sensor_bridge {
namespace {

constexpr double to_radians = std::numbers::pi / 180.0;
constexpr double to_metres = 1e-3;

struct Ray {
  double quality = 0.0;
  double bearing = 0.0;  // [rad]
  double range = 0.0;    // [m]
};

class JsonTriples final : public ScanReader {
 public:
  explicit JsonTriples(const std::filesystem::path& file) : lines_(file), text_(lines_) {}

  bool next(RecordedScan& scan) override {
    scan.clear();
    if (!begun_) {
      begun_ = true;
      scan.notes.emplace_back(
          "angles are taken for degrees, counter-clockwise, distances for millimetres; drivers of "
          "RPLIDARs count clockwise: set clockwise");
    }
    RevolutionSplit split;
    if (held_) add(*std::exchange(held_, std::nullopt), split, scan);
    while (true) {
      const char token = text_.peek();
      if (token == '\0') {
        if (depth_ > 0) text_.fail("the file ends inside a list; it is cut off");
        return !scan.ranges.empty();
      }
      if (text_.skip(',')) continue;
      if (text_.skip(']')) {
        if (--depth_ < 0) text_.fail("a ']' too many");
        if (!scan.ranges.empty()) return true;
        continue;
      }
      text_.expect('[');
      if (text_.peek() == '[' || text_.peek() == ']') {
        ++depth_;
        continue;
      }
      const Ray ray = read_ray();
      if (!scan.ranges.empty() && split.begins_anew(ray.bearing)) {
        held_ = ray;
        return true;
      }
      add(ray, split, scan);
    }
  }

  [[noreturn]] void fail(const std::string& what) const override { text_.fail(what); }

 private:
  /// Behind the opening bracket.
  Ray read_ray() {
    std::array<double, 3> values{};
    std::size_t count = 0;
    do {
      if (count == values.size()) text_.fail("a ray of more than [quality, angle, distance]");
      values[count++] = text_.number();
    } while (text_.skip(','));
    text_.expect(']');
    if (count < 2) text_.fail("a ray of less than [angle, distance]");
    const double angle = values[count - 2];
    if (!(std::abs(angle) <= 720.0)) text_.fail("an angle beyond two turns");
    return {count == 3 ? values[0] : 0.0, angle * to_radians, values[count - 1] * to_metres};
  }

  void add(const Ray& ray, RevolutionSplit& split, RecordedScan& scan) {
    if (scan.ranges.size() == RecordedScan::max_points) {
      text_.fail("more than " + std::to_string(RecordedScan::max_points) +
                 " rays that never come round");
    }
    split.add(ray.bearing);
    scan.bearings.push_back(static_cast<float>(ray.bearing));
    scan.ranges.push_back(static_cast<float>(ray.range));
    scan.qualities.push_back(static_cast<float>(ray.quality));
  }

  LineReader lines_;
  JsonText text_;
  bool begun_ = false;
  int depth_ = 0;
  std::optional<Ray> held_;
};

}  // namespace

std::unique_ptr<ScanReader> open_json_triples(const std::filesystem::path& file) {
  return std::make_unique<JsonTriples>(file);
}

}  // namespace quoin::sensor_bridge
