// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>

#include "core/sensor/points.hpp"

namespace quoin {

/// Largest bearing [rad] whose sine and cosine `compute_cartesian` gives to full accuracy, either
/// sign. A larger one is not a bearing.
inline constexpr double largest_bearing = 1e6;

/// Fills inverse_range, cosine, sine, x and y from range and bearing. Sine and cosine are exact to
/// 2 units in the last place (to 3e-16 near their zeros), much faster than calling std::sin and
/// std::cos in turn.
void compute_cartesian(Points& points);

/// The same for the points from place `at` on, whose bearing and range are these; both spans have
/// the same length, and the points have room for them.
void compute_cartesian(std::span<const float> bearings, std::span<const float> ranges,
                       std::size_t at, Points& points);

}  // namespace quoin
