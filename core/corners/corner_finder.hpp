// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "core/geometry/corner.hpp"
#include "core/geometry/line.hpp"
#include "core/parameters/parameter.hpp"

namespace quoin {

/// Corner of two lines of a scan.
struct Corner {
  CornerEstimate estimate;
  double angle = 0.0;          ///< [rad] between the lines, (0, pi/2]
  double opening = 0.0;        ///< [rad] of the free space between the walls, (0, 2 pi): less than
                               ///< pi where they enclose it, more where they stick out into it
  double gap = 0.0;            ///< [m] between the facing ends
  double extrapolation = 0.0;  ///< [m] from the corner to the farther of the facing ends
  bool seen = false;           ///< both walls up to the last ray before the corner
  std::size_t first_line = 0;
  std::size_t second_line = 0;
};

/// Why two neighbouring lines have no corner.
enum class NoCornerReason {
  small_angle,  ///< they are nearly parallel
  wide_gap,     ///< their facing ends are far apart
  far_away,     ///< they would meet far from a facing end
  inside_line,  ///< they would meet where one of them is seen to go on
};

template <>
struct EnumNames<NoCornerReason> {
  static constexpr std::array<std::pair<NoCornerReason, std::string_view>, 4> names{
      {{NoCornerReason::small_angle, "small_angle"},
       {NoCornerReason::wide_gap, "wide_gap"},
       {NoCornerReason::far_away, "far_away"},
       {NoCornerReason::inside_line, "inside_line"}}};
};

struct NoCorner {
  std::size_t first_line = 0;
  std::size_t second_line = 0;
  NoCornerReason reason = NoCornerReason::small_angle;
};

/// A word about each pair of neighbouring lines.
struct FoundCorners {
  std::vector<Corner> corners;
  std::vector<NoCorner> without;
};

/// Finds the corners of lines given in scanning order (the last is a neighbour of the first, across
/// the seam). The result is cleared first and keeps its memory.
using CornerFinder =
    std::function<void(std::span<const LineSegment>, double range_bias_stddev, FoundCorners&)>;

}  // namespace quoin
