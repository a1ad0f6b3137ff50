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

/// Points of the scan of each keyframe.
using KeyframePoints = std::vector<std::vector<SurfacePoint>>;

/// A keyframe of long before at which the last one may be, and how far the map may have drifted
/// since.
struct LoopPlace {
  std::size_t keyframe = 0;
  PoseWindow window;  ///< around the pose of the last keyframe
};

/// Nothing where there is none, or where the last keyframes see walls that it saw, too.
[[nodiscard]] std::optional<LoopPlace> find_loop_place(const LandmarkGraph& graph);

/// Looks for the points of the last keyframes on those around the place: an edge from its keyframe
/// to the last one, when there is one clear best pose.
[[nodiscard]] std::optional<LandmarkGraph::Edge> find_loop(const LandmarkGraph& graph,
                                                           const KeyframePoints& clouds,
                                                           const LoopPlace& place);

/// Of the edges found before, seen from the last one, those that put their keyframes where `edge`
/// does, half a metre apart: those from one place say the same again.
[[nodiscard]] std::vector<LandmarkGraph::Edge> agreeing_edges(
    const LandmarkGraph& graph, std::span<const LandmarkGraph::Edge> found,
    const LandmarkGraph::Edge& edge);

}  // namespace quoin
