// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/mapping/wall_selection.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <Eigen/LU>

#include "core/geometry/angle.hpp"
#include "core/statistics/order_statistics.hpp"

namespace quoin {
namespace {

constexpr double same_wall_gate = 9.21;  // chi square of 2, 99 %
constexpr std::size_t most_active = 120;

}  // namespace

std::vector<std::size_t> walls_around(std::span<const LineLandmark> map, const Pose2& pose,
                                      double reach, std::size_t keyframe) {
  std::vector<std::pair<double, std::size_t>> around;
  for (std::size_t i = 0; i < map.size(); ++i) {
    const LineLandmark& landmark = map[i];
    if (!landmark.alive) continue;
    // Seen once, long ago: something that moved.
    if (landmark.observations < 2 && landmark.last_keyframe + 30 < keyframe) continue;
    const Eigen::Vector2d from = Eigen::Vector2d(pose.x, pose.y) - landmark.anchor;
    const double s = std::clamp(landmark.along().dot(from), landmark.low, landmark.high);
    const double distance = (landmark.at(s) - Eigen::Vector2d(pose.x, pose.y)).norm();
    if (distance < reach) around.emplace_back(distance, i);
  }
  return indices_of_least(std::move(around), most_active);
}

void merge_same_walls(LandmarkGraph& graph, WallBelief& belief) {
  const std::vector<std::size_t>& walls = belief.landmarks;
  for (std::size_t a = 0; a < walls.size(); ++a) {
    for (std::size_t b = a + 1; b < walls.size(); ++b) {
      const LineLandmark& first = graph.landmarks()[walls[a]];
      const LineLandmark& second = graph.landmarks()[walls[b]];
      if (!first.alive || !second.alive) continue;
      const double turn = normalized_angle(second.phi - first.phi);
      if (std::abs(turn) > 0.2) continue;
      const double s0 = first.along().dot(second.at(second.low) - first.anchor);
      const double s1 = first.along().dot(second.at(second.high) - first.anchor);
      const double low = std::max(first.low, std::min(s0, s1));
      const double high = std::min(first.high, std::max(s0, s1));
      if (high - low < 0.25 * std::min(first.length(), second.length())) continue;
      const double s = 0.5 * (low + high);
      const Eigen::Vector2d point = first.at(s);
      const Eigen::Vector2d difference(turn,
                                       second.normal().dot(point - second.anchor) - second.offset);
      Eigen::Matrix<double, 2, 4> jacobian;
      jacobian << -1.0, 0.0, 1.0, 0.0, -s, 1.0, second.along().dot(point - second.anchor), -1.0;
      const auto ia = static_cast<Eigen::Index>(3 + 2 * a);
      const auto ib = static_cast<Eigen::Index>(3 + 2 * b);
      Eigen::Matrix4d joint;
      joint << belief.covariance.block<2, 2>(ia, ia), belief.covariance.block<2, 2>(ia, ib),
          belief.covariance.block<2, 2>(ib, ia), belief.covariance.block<2, 2>(ib, ib);
      const Eigen::Matrix2d c = jacobian * joint * jacobian.transpose() +
                                Eigen::Matrix2d(1e-12 * Eigen::Matrix2d::Identity());
      if (c(0, 0) > 0.04 * 0.04 || c(1, 1) > 0.06 * 0.06) continue;
      if (difference.dot(c.inverse() * difference) > same_wall_gate) continue;
      const bool keep_first = first.observations >= second.observations;
      graph.merge(keep_first ? walls[a] : walls[b], keep_first ? walls[b] : walls[a]);
    }
  }
  // The filter forgets the dropped ones: what they say of the pose is in the graph.
  belief.forget_merged(graph.landmarks());
}

std::vector<GivenWall> given_walls(std::span<const MapLine> map, double plan_stddev) {
  std::vector<GivenWall> result;
  for (const MapLine& line : map) {
    const double length = line.length();
    if (!(length > 0.0)) continue;
    const Eigen::Vector2d along = (line.end - line.start) / length;
    LineLandmark landmark;
    landmark.anchor = line.middle();
    landmark.phi = direction_of(along.y(), -along.x());
    landmark.low = -0.5 * length;
    landmark.high = 0.5 * length;
    landmark.observations = std::max<std::size_t>(line.observations, 3);
    Eigen::Matrix2d covariance = line.covariance;
    if (!(covariance.determinant() > 0.0)) {
      const double offset = plan_stddev;
      const double turn = std::min(2.0 * offset / length, 0.1);
      covariance = Eigen::Vector2d(turn * turn, offset * offset).asDiagonal();
    }
    result.push_back({landmark, covariance});
    if (line.observations > 0) continue;
    landmark.phi = normalized_angle(landmark.phi + pi);  // the other face
    result.push_back({landmark, covariance});
  }
  return result;
}

}  // namespace quoin
