// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>

namespace quoin {

/// How far the farthest point is, and which one, if that is more than the limit that was asked for.
struct FarthestPoint {
  std::size_t index = 0;  ///< 0 when no point is beyond the limit
  double distance = 0.0;  ///< [m]
};

/// Distance of the farthest of the points from the line normal_x x + normal_y y = offset, whose
/// normal has unit length. The spans have the same length and are not empty; the coordinates are
/// finite.
[[nodiscard]] double largest_distance(std::span<const double> x, std::span<const double> y,
                                      double normal_x, double normal_y, double offset);

/// Farthest of the points from the chord between the first and the last of them; from the first
/// point when the chord is shorter than the distance from it. `limit` [m] is what counts as far.
[[nodiscard]] FarthestPoint farthest_from_chord(std::span<const double> x,
                                                std::span<const double> y, double limit);

}  // namespace quoin
