// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>

namespace quoin {

/// The point that is farthest from a line, and how far.
struct FarthestPoint {
  std::size_t index = 0;
  double distance = 0.0;  ///< [m]
};

/// Farthest of the points from the line normal_x x + normal_y y = offset, whose normal has unit
/// length. The spans have the same length and are not empty; the coordinates are finite.
[[nodiscard]] FarthestPoint farthest_from_line(std::span<const double> x, std::span<const double> y,
                                               double normal_x, double normal_y, double offset);

/// Farthest of the points from the chord between the first and the last of them; from the first
/// point when the chord is shorter than the distance from it.
[[nodiscard]] FarthestPoint farthest_from_chord(std::span<const double> x,
                                                std::span<const double> y);

}  // namespace quoin
