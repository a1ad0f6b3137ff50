// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "core/fitting/inverse_range_regression.hpp"
#include "core/segmentation/segment.hpp"
#include "core/segmentation/tolerance.hpp"
#include "core/sensor/points.hpp"

namespace quoin {

/// Cheap line A x + B y = 1 through the inner points of a piece, with its sums.
struct InnerFit {
  InverseRangeSums sums;
  double a = 0.0;     ///< [1/m]
  double b = 0.0;     ///< [1/m]
  double norm = 0.0;  ///< [1/m] of (a, b); 0 when there is no line
};

/// The line of these sums.
[[nodiscard]] InnerFit inner_fit(const InverseRangeSums& sums);

/// The same line by its unit normal; the fit has a line.
[[nodiscard]] NormalLine normal_line(const InnerFit& fit);

/// A segment on the way to its final ends.
struct Piece {
  Segment segment;
  bool joined = false;  ///< to the piece before it: no break of the surface between them
  InnerFit fit{};       ///< filled by `fit_pieces`
};

/// Points that a piece keeps when others are taken from it.
inline constexpr std::size_t fewest_points = 3;

/// Points that may be missing between neighbours.
[[nodiscard]] std::size_t largest_gap(std::size_t min_points);

/// Drops pieces of fewer than `min_points` points. The neighbours of what is dropped become
/// neighbours, unless a break of the surface is between them.
void drop_small(std::size_t min_points, std::vector<Piece>& pieces);

/// Fits a line to the inner points of each piece that may have a joined neighbour; points at the
/// ends may be on that neighbour's wall.
void fit_pieces(const PointsView& points, std::vector<Piece>& pieces);

}  // namespace quoin
