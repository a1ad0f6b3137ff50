// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/sensor/scan_order.hpp"

#include <cmath>

#include "core/geometry/angle.hpp"
#include "core/sensor/multiversion.hpp"

namespace quoin {
namespace {

constexpr double full_turn = 2.0 * pi;

/// A gap between neighbouring bearings that no wall is followed through [rad].
constexpr double wide_gap = 10.0 * pi / 180.0;

/// The turn from one bearing to the next, in [-pi, pi].
inline double turn(double from, double to) {
  constexpr double rounding = 6755399441055744.0;  // rounds to the nearest integer, as in polar.cpp
  const double difference = to - from;
  const double turns = (difference * (1.0 / full_turn) + rounding) - rounding;
  return difference - turns * full_turn;
}

struct Extremes {
  double largest_turn = -full_turn;
  double smallest_turn = full_turn;
  double longest_range = 0.0;
  long turns_forward = 0;  // counter-clockwise steps less clockwise ones
};

QUOIN_MULTIVERSION
void find_extremes(const double* __restrict bearing, const double* __restrict range,
                   std::size_t count, Extremes& out) {
  Extremes extremes;
  extremes.longest_range = range[count - 1];
  for (std::size_t i = 0; i + 1 < count; ++i) {
    const double step = turn(bearing[i], bearing[i + 1]);
    extremes.largest_turn = step > extremes.largest_turn ? step : extremes.largest_turn;
    extremes.smallest_turn = step < extremes.smallest_turn ? step : extremes.smallest_turn;
    extremes.longest_range = range[i] > extremes.longest_range ? range[i] : extremes.longest_range;
    extremes.turns_forward += step > 0.0 ? 1 : 0;
    extremes.turns_forward -= step < 0.0 ? 1 : 0;
  }
  out = extremes;
}

/// True when the last of `count` points looks where the first one did, a whole turn later.
bool last_repeats_first(std::span<const double> bearings, std::size_t count) {
  if (count < 8) return false;
  const double spacing = full_turn / static_cast<double>(count - 1);
  if (std::abs(turn(bearings[0], bearings[count - 1])) > 0.01 * spacing) return false;
  // Half a turn away there must be points, else it is one direction measured again and again.
  return std::abs(turn(bearings[0], bearings[count / 2])) > 0.25 * pi;
}

}  // namespace

ScanOrder scan_order(std::span<const double> bearings, std::span<const double> ranges) {
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
  const double direction = order.clockwise ? -1.0 : 1.0;
  const auto previous = [count](std::size_t i) { return i == 0 ? count - 1 : i - 1; };
  const auto next = [count](std::size_t i) { return i + 1 == count ? 0 : i + 1; };

  // A sector, or a revolution that saw nothing in some sector: the widest gap is the break.
  // The step over a gap beyond half a turn appears as a large step backwards.
  const auto gap_before = [&](std::size_t i) {
    const double gap = direction * turn(bearings[previous(i)], bearings[i]);
    return gap < -wide_gap ? gap + full_turn : gap;
  };
  const double widest_inside = order.clockwise ? -extremes.smallest_turn : extremes.largest_turn;
  const double narrowest_inside = order.clockwise ? extremes.largest_turn : extremes.smallest_turn;
  const bool reversal = (order.clockwise ? -narrowest_inside : narrowest_inside) < -wide_gap;
  const double closing_gap = gap_before(0);
  if (closing_gap > wide_gap || widest_inside > wide_gap || reversal) {
    double widest = closing_gap;
    std::size_t behind_gap = 0;
    for (std::size_t i = 1; i < count; ++i) {
      const double gap = gap_before(i);
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
  std::size_t farthest = 0;
  while (ranges[farthest] < extremes.longest_range) ++farthest;
  const double jump_before = std::abs(ranges[farthest] - ranges[previous(farthest)]);
  const double jump_after = std::abs(ranges[farthest] - ranges[next(farthest)]);
  if (order.clockwise) {
    order.first = jump_after > jump_before ? farthest : previous(farthest);
  } else {
    order.first = jump_before > jump_after ? farthest : next(farthest);
  }
  return order;
}

}  // namespace quoin
