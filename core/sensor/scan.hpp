// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <limits>
#include <span>

#include "core/sensor/points.hpp"

namespace quoin {

/// One revolution or sweep in the order of acquisition, either direction of rotation, starting
/// anywhere; a view that does not own the arrays. Invalid ranges are NaN, infinite, zero, negative
/// or outside the limits.
struct ScanView {
  std::span<const float> bearings;  ///< [rad] counter-clockwise from x, any multiple of 2 pi
  std::span<const float> ranges;    ///< [m]
  float range_min = 0.0F;           ///< [m]
  float range_max = std::numeric_limits<float>::infinity();  ///< [m]
};

/// The valid points of `scan`, counter-clockwise, rotated so that they start at a break: behind the
/// largest jump in range around the farthest point, which no wall can pass through smoothly. Runs
/// of one wall are therefore contiguous although the scan has a seam. Returns the number of valid
/// points.
///
/// When bearings and ranges differ in length, the points that have both are used.
std::size_t convert(const ScanView& scan, Points& points);

}  // namespace quoin
