// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "core/mapping/landmark_graph.hpp"
#include "core/mapping/point_map.hpp"

namespace quoin {

inline constexpr double point_spacing = 0.05;  ///< [m] of a scan

/// Points on the lines of a scan, where it gives no others. The result is overwritten.
void points_of(std::span<const LineMeasurement> lines, std::vector<SurfacePoint>& result);
/// Points on a wall of the map, in its frame.
[[nodiscard]] std::vector<SurfacePoint> points_on(const LineLandmark& landmark);

/// Keyframes that see the same walls as those around `base`, within `reach` [m] of `pose`, and the
/// last ones up to it, in ascending order: what a scan at that pose is registered to.
[[nodiscard]] std::vector<std::size_t> keyframes_around(const LandmarkGraph& graph,
                                                        const Pose2& pose, std::size_t base,
                                                        double reach);

/// The keyframe whose pose is nearest, a radian counted as a metre.
[[nodiscard]] std::size_t nearest_keyframe(const LandmarkGraph& graph, const Pose2& pose);

/// Where a scan lies on the points around; nothing where too few of it do. Of several places that
/// fit about as well that near `predicted` counts.
[[nodiscard]] std::optional<Registration> register_scan(PointMap& around,
                                                        std::span<const SurfacePoint> scan,
                                                        const Pose2& predicted,
                                                        const PoseWindow& window);

}  // namespace quoin
