// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/mapping/loop_search.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Eigenvalues>

#include "core/geometry/angle.hpp"

namespace quoin {
namespace {

constexpr double loop_reach = 12.0;      // [m] of the points that loops are found by
constexpr double loop_pair_apart = 0.5;  // [m] between pairs that count

/// Points of some keyframes, from the pose of one of them.
std::vector<SurfacePoint> points_around(const LandmarkGraph& graph, const KeyframePoints& clouds,
                                        std::size_t keyframe, std::size_t first, std::size_t last) {
  const auto& keyframes = graph.keyframes();
  std::vector<SurfacePoint> points;
  for (std::size_t k = first; k <= last && k < keyframes.size(); ++k) {
    const Pose2 relative = between(keyframes[keyframe].pose, keyframes[k].pose);
    for (const SurfacePoint& point : clouds[k]) {
      if (point.position.norm() < loop_reach) points.push_back(transformed(relative, point));
    }
  }
  return points;
}

}  // namespace

std::optional<LoopPlace> find_loop_place(const LandmarkGraph& graph) {
  const auto& keyframes = graph.keyframes();
  const std::size_t now = keyframes.size() - 1;
  std::vector<char> seen(graph.landmarks().size(), 0);
  for (std::size_t k = now - 5; k <= now; ++k) {
    for (const auto& observation : keyframes[k].observations) seen[observation.landmark] = 1;
  }
  // How far the map may have drifted since each keyframe.
  double way = 0.0, turned = 0.0, best_distance = 1e9;
  std::optional<LoopPlace> place;
  const Pose2& here = keyframes[now].pose;
  for (std::size_t k = now; k-- > 0;) {
    const Pose2 step = between(keyframes[k].pose, keyframes[k + 1].pose);
    way += std::hypot(step.x, step.y);
    turned += std::abs(step.theta);
    if (k + 20 > now) continue;
    const double drift = std::min(4.0, 0.5 + 0.03 * way);
    const double distance = std::hypot(keyframes[k].pose.x - here.x, keyframes[k].pose.y - here.y);
    if (distance > drift + 1.0 || distance >= best_distance) continue;
    std::size_t common = 0;
    for (const auto& observation : keyframes[k].observations) {
      common += seen[observation.landmark] != 0 ? 1 : 0;
    }
    if (common >= 3) return std::nullopt;  // closed already
    best_distance = distance;
    const double turn = std::min(0.4, 0.1 + 0.002 * way + 0.002 * turned);
    place = LoopPlace{k, {here, drift, turn}};
  }
  return place;
}

std::optional<LandmarkGraph::Edge> find_loop(const LandmarkGraph& graph,
                                             const KeyframePoints& clouds, const LoopPlace& place) {
  const auto& keyframes = graph.keyframes();
  const std::size_t now = keyframes.size() - 1;
  PointMap around;
  const std::size_t old = place.keyframe;
  const Pose2& base = keyframes[old].pose;
  around.clear({base.x, base.y}, loop_reach + 2.0);
  const std::size_t first = old > 6 ? old - 6 : 0;
  for (std::size_t k = first; k <= std::min(old + 6, now); ++k)
    around.add(keyframes[k].pose, clouds[k]);
  const std::vector<SurfacePoint> recent = points_around(graph, clouds, now, now - 6, now);
  const std::vector<PointMap::Candidate> found = around.search(recent, place.window, 3);
  if (found.empty()) return std::nullopt;
  std::vector<Registration> refined;
  for (const PointMap::Candidate& candidate : found) {
    const PoseEstimate prior{candidate.pose, 0.04 * Eigen::Matrix3d::Identity()};
    refined.push_back(around.refine(recent, candidate.pose, prior));
  }
  const auto best = std::max_element(
      refined.begin(), refined.end(),
      [](const Registration& a, const Registration& b) { return a.share < b.share; });
  double second = 0.0;
  for (const Registration& other : refined) {
    const Pose2 apart = between(best->estimate.pose, other.estimate.pose);
    if (std::hypot(apart.x, apart.y) > 0.3 || std::abs(apart.theta) > 0.15) {
      second = std::max(second, other.share);
    }
  }
  if (best->share < 0.55 || second > 0.85 * best->share) return std::nullopt;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes(
      Eigen::Matrix2d(best->estimate.covariance.topLeftCorner<2, 2>()));
  if (axes.eigenvalues()(1) > 0.1 * 0.1) return std::nullopt;
  LandmarkGraph::Edge edge;
  edge.from = old;
  edge.to = now;
  edge.motion.pose = between(base, best->estimate.pose);
  edge.motion.covariance = covariance_in_frame(base, best->estimate.covariance);
  return edge;
}

std::vector<LandmarkGraph::Edge> agreeing_edges(const LandmarkGraph& graph,
                                                std::span<const LandmarkGraph::Edge> found,
                                                const LandmarkGraph::Edge& edge) {
  const auto& keyframes = graph.keyframes();
  const Pose2& here = keyframes[edge.to].pose;
  const Pose2& base = keyframes[edge.from].pose;
  std::vector<LandmarkGraph::Edge> agreeing;
  Pose2 last = here;
  for (auto pending = found.rbegin(); pending != found.rend(); ++pending) {
    const Pose2 to = keyframes[pending->to].pose;
    if (!agreeing.empty() && std::hypot(to.x - last.x, to.y - last.y) < loop_pair_apart) continue;
    const Pose2 one = compose(keyframes[pending->from].pose, pending->motion.pose);
    const Pose2 two = compose(base, edge.motion.pose);
    const Pose2 off = between(between(to, here), between(one, two));
    if (std::hypot(off.x, off.y) >= 0.3 || std::abs(off.theta) >= 0.06) continue;
    agreeing.push_back(*pending);
    last = to;
  }
  return agreeing;
}

}  // namespace quoin
