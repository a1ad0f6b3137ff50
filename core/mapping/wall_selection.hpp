// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/mapping/landmark_graph.hpp"
#include "core/mapping/line_map.hpp"
#include "core/mapping/wall_belief.hpp"

namespace quoin {

/// Walls of a map nearer than `reach` [m], in ascending order. `keyframe` is the one that the
/// filter begins from.
[[nodiscard]] std::vector<std::size_t> walls_around(std::span<const LineLandmark> map,
                                                    const Pose2& pose, double reach,
                                                    std::size_t keyframe);

/// Merges walls that are one within their joint covariance, where that is narrow enough to tell.
/// The belief forgets the dropped ones: what they say of the pose is in the graph.
void merge_same_walls(LandmarkGraph& graph, WallBelief& belief);

/// The walls of a given map as landmarks, each with the covariance of (phi, offset).
struct GivenWall {
  LineLandmark landmark;
  Eigen::Matrix2d covariance;
};
/// A wall without observations is a plan's, seen from either side: two landmarks. One without a
/// covariance gets `plan_stddev` [m].
[[nodiscard]] std::vector<GivenWall> given_walls(std::span<const MapLine> map, double plan_stddev);

}  // namespace quoin
