// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "core/fitting/inverse_range_regression.hpp"
#include "core/segmentation/segment.hpp"
#include "core/sensor/points.hpp"

namespace quoin {

/// Cheap line A x + B y = 1 through the inner points of a piece, with its sums.
struct InnerFit {
  InverseRangeSums sums;
  double a = 0.0;     ///< [1/m]
  double b = 0.0;     ///< [1/m]
  double norm = 0.0;  ///< [1/m] of (a, b); 0 when there is no line
};

/// A segment on the way to its final ends.
struct Piece {
  Segment segment;
  bool joined = false;  ///< to the piece before it: no break of the surface between them
  InnerFit fit{};       ///< filled by `refine`
};

/// Improves what a splitting segmenter has found. A vertex is chosen for being far from a chord,
/// that is also for its noise, and is a few points off the corner: one wall's fit then contains
/// points of the other. So lines are fitted to the inner points of all pieces, and
/// - neighbours on one line, which noise had split, become one piece again, best match first;
/// - between others the boundary moves to the bearing of the intersection, and the point nearest to
///   the corner on either side is left out, because noise decides which wall it seems to be on.
///
/// `closed` says that the last piece and the first are joined too, across the seam; there points
/// are only left out. Pieces of fewer than `min_points` vanish, their points may go to the
/// neighbours. No point ends up farther than `tolerance` [m] from the line it was moved to.
void refine(const PointsView& points, std::size_t min_points, double tolerance, bool closed,
            std::vector<Piece>& pieces);

}  // namespace quoin
