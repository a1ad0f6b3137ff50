// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "core/geometry/corner.hpp"
#include "core/geometry/line.hpp"

namespace quoin {

/// Corner of two lines of a scan.
struct Corner {
  CornerEstimate estimate;
  double angle = 0.0;          ///< [rad] between the lines, (0, pi/2]
  double gap = 0.0;            ///< [m] between the facing ends
  double extrapolation = 0.0;  ///< [m] from the corner to the farther of the facing ends
  std::size_t first_line = 0;
  std::size_t second_line = 0;
};

/// Finds the corners of lines given in scanning order (the last is a neighbour of the first, across
/// the seam). The vector is cleared first and keeps its memory.
using CornerFinder = std::function<void(std::span<const LineSegment>, double range_bias_stddev,
                                        std::vector<Corner>&)>;

}  // namespace quoin
