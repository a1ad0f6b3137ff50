// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "core/fitting/point_sums.hpp"
#include "core/geometry/line.hpp"
#include "core/segmentation/segment.hpp"
#include "core/segmentation/tolerance.hpp"
#include "core/sensor/points.hpp"

namespace quoin {

/// A segment on the way to its final ends.
struct Piece {
  Segment segment;
  bool joined = false;  ///< to the piece before it: no break of the surface between them
  Moments moments{};    ///< of the inner points, with the weights 1 / range^2
  std::optional<NormalLine> line{};  ///< algebraic, cheap; both are filled by `fit_pieces`
  bool round = false;                ///< no line, but an arc
  /// `refine_boundaries` has left out what is nearest to the corner.
  bool begins_at_corner = false, ends_at_corner = false;
};

/// Points that a piece keeps when others are taken from it.
inline constexpr std::size_t fewest_points = 3;

/// Points that may be missing between neighbours.
[[nodiscard]] std::size_t largest_gap(std::size_t min_points);

/// Drops pieces of fewer than `fewest` points. The neighbours of what is dropped become neighbours,
/// unless a break of the surface is between them.
void drop_small(std::size_t fewest, std::size_t min_points, std::vector<Piece>& pieces);

/// The line that these moments determine; nothing when they determine none.
[[nodiscard]] std::optional<NormalLine> line_of(const Moments& moments);

/// Fits a line to the inner points of each piece that has none and may have a joined neighbour;
/// points at the ends may be on that neighbour's wall.
void fit_pieces(const PointsView& points, std::vector<Piece>& pieces);

/// Moves the boundaries between neighbours to where their lines meet. A vertex is chosen for being
/// far from a line, that is also for its noise, and is a few points off the corner: one wall's fit
/// then contains points of the other. The boundary goes to the bearing of the intersection, and the
/// point nearest to the corner on either side is left out, because noise decides which wall it
/// seems to be on, with those that are nearer to it than two standard deviations of where it is. No
/// point ends up farther than the tolerance from the line it was moved to.
///
/// `closed` says that the last piece and the first are joined too, across the seam; there points
/// are only left out. The pieces have been fitted.
void refine_boundaries(const PointsView& points, std::size_t min_points, const Tolerance& tolerance,
                       bool closed, std::vector<Piece>& pieces);

}  // namespace quoin
