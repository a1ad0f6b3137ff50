// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "core/segmentation/breakpoints.hpp"
#include "core/segmentation/segment.hpp"
#include "core/sensor/points.hpp"

namespace quoin {

/// Adds the points that hold what a sensor writes where nothing came back, ascending: the range of
/// a run of rays that is the same to the digit although no flat wall is at one range over so wide
/// an angle, wherever that range occurs.
void find_fill(const PointsView& points, const SensorModel& sensor, std::vector<std::size_t>& fill);

/// Adds to `strays` the points of groups of at most `most` points behind which a surface goes on,
/// ascending: stray returns, error codes, thin things in front of a wall. `clusters` are those that
/// `breakpoints` found in these points, and become those of the other points.
void pass_over_strays(const CoarsePoints& points, const BreakpointDetector& breakpoints,
                      std::size_t most, std::vector<Segment>& clusters,
                      std::vector<std::size_t>& strays);

/// Standard deviation [m] of the range from ray to ray, whatever walls there are: from how far the
/// inverse of a range is from the line through both neighbours', which it is on for any straight
/// wall. The median, so that edges do not count. 0 when there are too few points.
[[nodiscard]] double range_noise(const PointsView& points);

/// The same by the sensor model: [m] root of the mean variance over the points.
[[nodiscard]] double declared_range_noise(const PointsView& points, const SensorModel& sensor);

}  // namespace quoin
