// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/sensor/scan.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

#include "core/geometry/angle.hpp"
#include "core/sensor/multiversion.hpp"

namespace quoin {
namespace {

/// As bit patterns. Compared as integers, positive numbers keep their order, and NaN and infinity
/// are beyond all limits. This file is compiled with -ffinite-math-only, which assumes that there
/// is no NaN.
struct ScanLimits {
  std::int32_t range_min, range_max, bearing_max;
};

constexpr std::int32_t bits_of(float number) { return std::bit_cast<std::int32_t>(number); }

ScanLimits limits_of(const ScanView& scan) {
  constexpr std::int32_t infinity = 0x7f800000;
  const std::int32_t range_max = bits_of(scan.range_max);
  return {std::max(bits_of(scan.range_min), 1),
          range_max > infinity ? -1 : std::min(range_max, infinity - 1),
          bits_of(static_cast<float>(largest_bearing))};
}

inline int is_valid(float bearing, float range, const ScanLimits& limits) {
  constexpr std::int32_t all_but_sign = 0x7fffffff;
  return static_cast<int>(bits_of(range) >= limits.range_min) &
         static_cast<int>(bits_of(range) <= limits.range_max) &
         static_cast<int>((bits_of(bearing) & all_but_sign) <= limits.bearing_max);
}

QUOIN_MULTIVERSION
int count_valid(const float* __restrict bearings, const float* __restrict ranges, std::size_t count,
                ScanLimits limits) {
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
  const ScanLimits limits = limits_of(scan);
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

/// How the points of a scan are to be read so that they run counter-clockwise from a break.
struct ScanOrder {
  bool clockwise = false;  ///< acquired clockwise: read backwards
  std::size_t first = 0;   ///< index, in the order of acquisition, of the point to start with
  std::size_t count = 0;   ///< points to read; one less than given when the last repeats the first
};

constexpr float full_turn = 2.0F * static_cast<float>(pi);

/// A gap between neighbouring bearings that no wall is followed through [rad].
constexpr float wide_gap = 10.0F * static_cast<float>(pi) / 180.0F;

/// The turn from one bearing to the next, in [-pi, pi] but for rounding.
inline float turn(float from, float to) {
  constexpr float rounding = 12582912.0F;  // 1.5 * 2^23 rounds to the nearest integer
  const float difference = to - from;
  const float turns = (difference * (1.0F / full_turn) + rounding) - rounding;
  return difference - turns * full_turn;
}

struct Extremes {
  float largest_turn = -full_turn;
  float smallest_turn = full_turn;
  float longest_range = 0.0F;
  int turns_forward = 0;  // counter-clockwise steps less clockwise ones
};

QUOIN_MULTIVERSION
void find_extremes(const float* __restrict bearing, const float* __restrict range,
                   std::size_t count, Extremes& out) {
  Extremes extremes;
  extremes.longest_range = range[count - 1];
  for (std::size_t i = 0; i + 1 < count; ++i) {
    const float step = turn(bearing[i], bearing[i + 1]);
    extremes.largest_turn = step > extremes.largest_turn ? step : extremes.largest_turn;
    extremes.smallest_turn = step < extremes.smallest_turn ? step : extremes.smallest_turn;
    extremes.longest_range = range[i] > extremes.longest_range ? range[i] : extremes.longest_range;
    extremes.turns_forward += step > 0.0F ? 1 : 0;
    extremes.turns_forward -= step < 0.0F ? 1 : 0;
  }
  out = extremes;
}

/// The first index of a range that is not less than the longest.
QUOIN_MULTIVERSION
std::size_t index_of_longest(const float* __restrict range, std::size_t count, float longest) {
  const auto none = static_cast<unsigned>(count);
  unsigned first = none;
  for (unsigned i = 0; i < none; ++i) {
    const unsigned index = range[i] >= longest ? i : none;
    first = index < first ? index : first;
  }
  return first;
}

/// True when the last of `count` points looks where the first one did, a whole turn later.
bool last_repeats_first(std::span<const float> bearings, std::size_t count) {
  if (count < 8) return false;
  const float spacing = full_turn / static_cast<float>(count - 1);
  if (std::abs(turn(bearings[0], bearings[count - 1])) > 0.01F * spacing) return false;
  // Half a turn away there must be points, else it is one direction measured again and again.
  return std::abs(turn(bearings[0], bearings[count / 2])) > 0.25F * static_cast<float>(pi);
}

/// Bearings [rad] and ranges [m] of valid points in the order of acquisition; that order is
/// trusted, because noise of the bearings may swap neighbours. Both spans have the same length.
ScanOrder scan_order(std::span<const float> bearings, std::span<const float> ranges) {
  ScanOrder order;
  order.count = bearings.size();
  if (last_repeats_first(bearings, order.count)) --order.count;
  const std::size_t count = order.count;
  if (count < 2) return order;

  Extremes extremes;
  find_extremes(bearings.data(), ranges.data(), count, extremes);
  // The majority decides: single steps may go backwards by noise, or around by more than half a
  // turn where a large part of the scan saw nothing.
  order.clockwise = extremes.turns_forward < 0;
  const float direction = order.clockwise ? -1.0F : 1.0F;
  const auto previous = [count](std::size_t i) { return i == 0 ? count - 1 : i - 1; };
  const auto next = [count](std::size_t i) { return i + 1 == count ? 0 : i + 1; };

  // A sector, or a revolution that saw nothing in some sector: the widest gap is the break.
  // The step over a gap beyond half a turn appears as a large step backwards.
  const auto gap_before = [&](std::size_t i) {
    const float gap = direction * turn(bearings[previous(i)], bearings[i]);
    return gap < -wide_gap ? gap + full_turn : gap;
  };
  const float widest_inside = order.clockwise ? -extremes.smallest_turn : extremes.largest_turn;
  const float narrowest_inside = order.clockwise ? extremes.largest_turn : extremes.smallest_turn;
  const bool reversal = (order.clockwise ? -narrowest_inside : narrowest_inside) < -wide_gap;
  const float closing_gap = gap_before(0);
  if (closing_gap > wide_gap || widest_inside > wide_gap || reversal) {
    float widest = closing_gap;
    std::size_t behind_gap = 0;
    for (std::size_t i = 1; i < count; ++i) {
      const float gap = gap_before(i);
      if (gap > widest) {
        widest = gap;
        behind_gap = i;
      }
    }
    // Reading backwards starts at the same point of acquisition order: the one behind the gap in
    // counter-clockwise sense is the one before it in order of acquisition.
    order.first = order.clockwise ? previous(behind_gap) : behind_gap;
    return order;
  }

  // Along a wall the range is a convex function of the position, so the farthest point ends a wall.
  const std::size_t farthest = index_of_longest(ranges.data(), count, extremes.longest_range);
  const float jump_before = std::abs(ranges[farthest] - ranges[previous(farthest)]);
  const float jump_after = std::abs(ranges[farthest] - ranges[next(farthest)]);
  if (order.clockwise) {
    order.first = jump_after > jump_before ? farthest : previous(farthest);
  } else {
    order.first = jump_before > jump_after ? farthest : next(farthest);
  }
  return order;
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

}  // namespace quoin
