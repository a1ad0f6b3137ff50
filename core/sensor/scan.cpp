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

/// Copies all points and returns how many of them are valid.
QUOIN_MULTIVERSION
int copy_all(const float* __restrict from_bearings, const float* __restrict from_ranges,
             std::size_t count, Limits limits, double* __restrict bearings,
             double* __restrict ranges) {
  int valid = 0;
  for (std::size_t i = 0; i < count; ++i) {
    bearings[i] = static_cast<double>(from_bearings[i]);
    ranges[i] = static_cast<double>(from_ranges[i]);
    valid += is_valid(from_bearings[i], from_ranges[i], limits);
  }
  return valid;
}

/// Copies the valid points in the order of acquisition; returns how many there are.
std::size_t copy_valid(const ScanView& scan, std::size_t count, double* bearings, double* ranges) {
  const Limits limits{std::max(scan.range_min, std::numeric_limits<float>::denorm_min()),
                      std::min(scan.range_max, std::numeric_limits<float>::max()),
                      static_cast<float>(largest_bearing)};
  const int all_valid =
      copy_all(scan.bearings.data(), scan.ranges.data(), count, limits, bearings, ranges);
  if (static_cast<std::size_t>(all_valid) == count) return count;
  std::size_t valid = 0;
  for (std::size_t i = 0; i < count; ++i) {
    // Without a branch: dropouts come at random.
    bearings[valid] = static_cast<double>(scan.bearings[i]);
    ranges[valid] = static_cast<double>(scan.ranges[i]);
    valid += static_cast<std::size_t>(is_valid(scan.bearings[i], scan.ranges[i], limits));
  }
  return valid;
}

/// Copies `order.count` elements from `order.first` on, around the end, in reading direction.
void copy_ordered(const ScanOrder& order, const double* from, double* to) {
  const auto first = static_cast<std::ptrdiff_t>(order.first);
  const auto count = static_cast<std::ptrdiff_t>(order.count);
  if (order.clockwise) {
    double* const wrapped = std::reverse_copy(from, from + first + 1, to);
    std::reverse_copy(from + first + 1, from + count, wrapped);
  } else {
    std::rotate_copy(from, from + first, from + count, to);
  }
}

}  // namespace

std::size_t convert(const ScanView& scan, Points& points) {
  const std::size_t count = std::min(scan.bearings.size(), scan.ranges.size());
  points.resize(count);
  // x and y are free until the points are in order.
  const std::size_t valid = copy_valid(scan, count, points.x.data(), points.y.data());
  const ScanOrder order = scan_order({points.x.data(), valid}, {points.y.data(), valid});
  if (order.count > 0) {
    copy_ordered(order, points.x.data(), points.bearing.data());
    copy_ordered(order, points.y.data(), points.range.data());
  }
  points.resize(order.count);
  compute_cartesian(points);
  return order.count;
}

void convert_ordered(std::span<const float> bearings, std::span<const float> ranges,
                     Points& points) {
  const std::size_t count = std::min(bearings.size(), ranges.size());
  points.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    points.bearing[i] = static_cast<double>(bearings[i]);
    points.range[i] = static_cast<double>(ranges[i]);
  }
  compute_cartesian(points);
}

}  // namespace quoin
