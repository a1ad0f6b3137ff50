// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/sensor/scan.hpp"

#include <algorithm>
#include <cmath>

#include "core/sensor/multiversion.hpp"
#include "core/sensor/polar.hpp"
#include "core/sensor/scan_order.hpp"

namespace quoin {
namespace {

struct Limits {
  float range_min, range_max, bearing_max;
};

/// Comparisons with NaN are false.
inline int is_valid(float bearing, float range, const Limits& limits) {
  return static_cast<int>(range >= limits.range_min) & static_cast<int>(range <= limits.range_max) &
         static_cast<int>(std::abs(bearing) <= limits.bearing_max);
}

QUOIN_MULTIVERSION
int count_valid(const float* __restrict bearings, const float* __restrict ranges, std::size_t count,
                Limits limits) {
  int valid = 0;
  for (std::size_t i = 0; i < count; ++i) valid += is_valid(bearings[i], ranges[i], limits);
  return valid;
}

/// Bearings and ranges of the same length, in the order of acquisition.
struct Readings {
  std::span<const float> bearings, ranges;

  [[nodiscard]] Readings subspan(std::size_t begin, std::size_t count) const {
    return {bearings.subspan(begin, count), ranges.subspan(begin, count)};
  }
};

/// The valid ones; copied to the working memory of `points` when there are others between them.
Readings valid_readings(const Readings& all, const ScanView& scan, Points& points) {
  const Limits limits{std::max(scan.range_min, std::numeric_limits<float>::denorm_min()),
                      std::min(scan.range_max, std::numeric_limits<float>::max()),
                      static_cast<float>(largest_bearing)};
  const std::size_t count = all.ranges.size();
  const int all_valid = count_valid(all.bearings.data(), all.ranges.data(), count, limits);
  if (static_cast<std::size_t>(all_valid) == count) return all;
  points.scan_bearing.resize(count);
  points.scan_range.resize(count);
  std::size_t valid = 0;
  for (std::size_t i = 0; i < count; ++i) {
    // Without a branch: dropouts come at random.
    points.scan_bearing[valid] = all.bearings[i];
    points.scan_range[valid] = all.ranges[i];
    valid += static_cast<std::size_t>(is_valid(all.bearings[i], all.ranges[i], limits));
  }
  return Readings{points.scan_bearing, points.scan_range}.subspan(0, valid);
}

/// The same backwards, in the working memory of `points`, where they may be already.
Readings reversed(const Readings& readings, Points& points) {
  const auto reverse = [](std::span<const float> from, std::vector<float>& to) {
    if (from.data() == to.data()) {
      to.resize(from.size());
      std::reverse(to.begin(), to.end());
    } else {
      to.assign(from.rbegin(), from.rend());
    }
  };
  reverse(readings.bearings, points.scan_bearing);
  reverse(readings.ranges, points.scan_range);
  return {points.scan_bearing, points.scan_range};
}

}  // namespace

std::size_t convert(const ScanView& scan, Points& points) {
  const std::size_t given = std::min(scan.bearings.size(), scan.ranges.size());
  Readings readings =
      valid_readings({scan.bearings.first(given), scan.ranges.first(given)}, scan, points);
  const ScanOrder order = scan_order(readings.bearings, readings.ranges);
  points.resize(order.count);
  if (order.count == 0) return 0;
  readings = readings.subspan(0, order.count);
  std::size_t first = order.first;
  if (order.clockwise) {
    readings = reversed(readings, points);
    first = order.count - 1 - first;
  }
  const std::size_t before_seam = order.count - first;
  const Readings start = readings.subspan(first, before_seam);
  const Readings rest = readings.subspan(0, first);
  compute_cartesian(start.bearings, start.ranges, 0, points);
  compute_cartesian(rest.bearings, rest.ranges, before_seam, points);
  return order.count;
}

void convert_ordered(std::span<const float> bearings, std::span<const float> ranges,
                     Points& points) {
  const std::size_t count = std::min(bearings.size(), ranges.size());
  points.resize(count);
  compute_cartesian(bearings.first(count), ranges.first(count), 0, points);
}

}  // namespace quoin
