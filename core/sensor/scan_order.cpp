// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/sensor/scan_order.hpp"

#include <cmath>

#include "core/geometry/angle.hpp"
#include "core/sensor/multiversion.hpp"

namespace quoin {
namespace {

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

/// The first place of a range that is not less than the longest.
QUOIN_MULTIVERSION
std::size_t place_of_longest(const float* __restrict range, std::size_t count, float longest) {
  const auto none = static_cast<unsigned>(count);
  unsigned first = none;
  for (unsigned i = 0; i < none; ++i) {
    const unsigned place = range[i] >= longest ? i : none;
    first = place < first ? place : first;
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

}  // namespace

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
  const std::size_t farthest = place_of_longest(ranges.data(), count, extremes.longest_range);
  const float jump_before = std::abs(ranges[farthest] - ranges[previous(farthest)]);
  const float jump_after = std::abs(ranges[farthest] - ranges[next(farthest)]);
  if (order.clockwise) {
    order.first = jump_after > jump_before ? farthest : previous(farthest);
  } else {
    order.first = jump_before > jump_after ? farthest : next(farthest);
  }
  return order;
}

}  // namespace quoin
