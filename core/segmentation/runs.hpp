// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "core/segmentation/moment_sums.hpp"
#include "core/segmentation/segment.hpp"
#include "core/segmentation/tolerance.hpp"
#include "core/sensor/points.hpp"

namespace quoin {

/// Squared distance of point `i` from the line in units of its squared tolerance.
[[nodiscard]] double excess_of(const NormalLine& line, const PointsView& points, std::size_t i,
                               const Tolerance& tolerance);

/// Squared, in squared tolerances: outliers beyond it end a run, for a segment keeps all its points
/// and no fit of it would be right.
inline constexpr double largest_outlier = 4.0;

/// Points off the line that a run may pass over at a time.
inline constexpr std::size_t largest_gap_in_run = 2;

/// The points around point `inside` that are within their tolerance of the line without a gap,
/// inside `range`. Mild outliers are passed over when points on the line follow. Empty
/// when that point itself is off the line.
[[nodiscard]] Segment run_around(const PointsView& points, const Segment& range, std::size_t inside,
                                 const NormalLine& line, const Tolerance& tolerance);

/// The longest of all such runs in `range`.
[[nodiscard]] Segment longest_run(const PointsView& points, const Segment& range,
                                  const NormalLine& line, const Tolerance& tolerance);

/// The run that its own fitted line has around its middle, or the longest where the middle is off
/// the line, fitted again until it stays.
[[nodiscard]] Segment refined_run(const PointsView& points, const PrefixMoments& moments,
                                  const Segment& range, const Segment& run,
                                  const Tolerance& tolerance);

/// The straight run of a piece: the longest near the line of all its points, refined inside it.
[[nodiscard]] Segment straight_run(const PointsView& points, const PrefixMoments& moments,
                                   const Segment& piece, const Tolerance& tolerance);

}  // namespace quoin
