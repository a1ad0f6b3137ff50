// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <utility>

#include <Eigen/LU>

#include "core/mapping/landmarks.hpp"
#include "core/mapping/line_gates.hpp"
#include "core/mapping/nearby_points.hpp"
#include "core/mapping/wall_selection.hpp"

// How Landmarks go on from one keyframe to the next.

namespace quoin {
namespace {

constexpr double near_gate = 30.0;  // what is nearer than this is no new wall
constexpr std::size_t refresh_keyframes = 12;
constexpr double refresh_distance = 4.0;  // [m]

/// Whether a line may be of a wall that the belief holds, for all that is known.
bool is_near_a_wall(const WallBelief& belief, std::span<const LineLandmark> map, std::size_t walls,
                    const LineMeasurement& m) {
  for (std::size_t k = 0; k < walls; ++k) {
    const LineLandmark landmark = belief.wall(map, k);
    if (std::cos(belief.pose.theta + m.alpha - landmark.phi) < 0.8) continue;
    if (overlap(belief.pose, landmark, m) <= 0.0) continue;
    const LineResidual residual = line_residual(belief.pose, landmark, m);
    const Eigen::Matrix2d s = innovation_covariance(residual, belief.covariance, k, m.covariance);
    if (s(1, 1) < widest_offset * widest_offset &&
        residual.value.dot(s.inverse() * residual.value) < near_gate) {
      return true;
    }
  }
  return false;
}

}  // namespace

/// Whether the scan shows nothing that the map does not have from near this pose: another keyframe
/// would only make the graph grow.
bool Landmarks::is_known(const Pose2& pose, double matched, double total) const {
  if (!given_.empty()) return true;
  if (share_ < 0.8 || matched < 0.9 * total) return false;
  const Pose2 apart = between(graph_.keyframes()[nearest_keyframe(graph_, pose)].pose, pose);
  return std::hypot(apart.x, apart.y) < parameters_.keyframe_distance &&
         std::abs(apart.theta) < parameters_.keyframe_angle;
}

/// The filter goes on from here without a new keyframe, and from time to time with other walls.
void Landmarks::go_on(const WallBelief& posterior) {
  belief_ = posterior;
  since_ = PoseEstimate{};
  base_is_keyframe_ = false;
  if (std::hypot(belief_.pose.x - refreshed_at_.x, belief_.pose.y - refreshed_at_.y) <
      refresh_distance) {
    return;
  }
  if (given_.empty()) {
    // From the nearest keyframe, with what the points say of the way from there.
    base_keyframe_ = nearest_keyframe(graph_, posterior.pose);
    const Pose2 from = graph_.keyframes()[base_keyframe_].pose;
    refresh();
    since_ = {between(from, posterior.pose), covariance_in_frame(from, by_points_.covariance)};
    base_is_keyframe_ = true;
  } else {
    refresh();
  }
  rebuild_near();
}

void Landmarks::add_keyframe(const WallBelief& posterior, const WallPairs& pairs) {
  PoseEstimate motion = motion_;
  if (!base_is_keyframe_) {
    base_keyframe_ = nearest_keyframe(graph_, posterior.pose);
    const Pose2& from = graph_.keyframes()[base_keyframe_].pose;
    motion = {between(from, by_points_.pose), covariance_in_frame(from, by_points_.covariance)};
  }
  const std::size_t keyframe = graph_.add_keyframe(base_keyframe_, posterior.pose, motion);
  base_keyframe_ = keyframe;
  base_is_keyframe_ = true;
  belief_ = posterior;
  clouds_.push_back(scan_);
  for (const auto& [i, k] : pairs) {
    LineLandmark& landmark = graph_.landmarks()[belief_.landmarks[k]];
    landmark.phi = posterior.walls[k](0);
    landmark.offset = posterior.walls[k](1);
    extend(landmark, posterior.pose, measurements_[i]);
    graph_.observe(keyframe, belief_.landmarks[k], measurements_[i]);
  }
  add_new_walls(keyframe, pairs);
  since_ = PoseEstimate{};
  const Eigen::Vector2d here(belief_.pose.x, belief_.pose.y);
  if (near_.empty() || (here - near_.center()).norm() > 4.0) rebuild_near();
  near_.add(belief_.pose, scan_);
  const double way = std::hypot(belief_.pose.x - refreshed_at_.x, belief_.pose.y - refreshed_at_.y);
  loops_.check(graph_);
  const bool closed = loops_.close(graph_);
  if (closed || refresh_again_ || keyframe >= refreshed_keyframe_ + refresh_keyframes ||
      way > refresh_distance) {
    refresh();
    rebuild_near();
    refresh_again_ = closed;
  }
}

void Landmarks::add_new_walls(std::size_t keyframe, const WallPairs& known) {
  std::vector<char> used(measurements_.size(), 0);
  for (const auto& pair : known) used[pair.first] = 1;
  const std::size_t walls = belief_.walls.size();
  for (std::size_t i = 0; i < measurements_.size(); ++i) {
    const LineMeasurement& m = measurements_[i];
    if (used[i] != 0 || 2.0 * m.half_length < parameters_.min_length) continue;
    if (is_near_a_wall(belief_, graph_.landmarks(), walls, m)) continue;
    const LineLandmark landmark = landmark_of(belief_.pose, m);
    const std::size_t index = graph_.add_landmark(landmark);
    graph_.observe(keyframe, index, m);
    append_wall(belief_, index, landmark, m);
  }
}

/// One step of the whole graph, and the filter anew from its joint covariance.
void Landmarks::refresh() {
  const std::size_t keyframe = base_keyframe_;
  const Pose2 pose = given_.empty() ? graph_.keyframes()[keyframe].pose : belief_.pose;
  std::vector<std::size_t> walls =
      walls_around(graph_.landmarks(), pose, parameters_.reach, keyframe);
  if (given_.empty()) {
    Eigen::MatrixXd covariance = graph_.marginal_after_step(keyframe, walls);
    if (covariance.rows() == 0) return;
    belief_.covariance = std::move(covariance);
    belief_.pose = graph_.keyframes()[keyframe].pose;
  } else {
    const auto size = static_cast<Eigen::Index>(3 + 2 * walls.size());
    Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(size, size);
    covariance.topLeftCorner<3, 3>() = belief_.covariance.topLeftCorner<3, 3>();
    for (std::size_t k = 0; k < walls.size(); ++k) {
      const auto at = static_cast<Eigen::Index>(3 + 2 * k);
      covariance.block<2, 2>(at, at) = given_[walls[k]];
    }
    belief_.covariance = std::move(covariance);
  }
  belief_.landmarks = std::move(walls);
  belief_.walls.clear();
  for (const std::size_t index : belief_.landmarks) {
    belief_.walls.emplace_back(graph_.landmarks()[index].phi, graph_.landmarks()[index].offset);
  }
  refreshed_ = true;
  refreshed_at_ = belief_.pose;
  refreshed_keyframe_ = keyframe;
  if (given_.empty()) merge_same_walls(graph_, belief_);
}

/// The points around, of keyframes that see the same walls; of a given map those of its walls.
void Landmarks::rebuild_near() {
  near_.clear({belief_.pose.x, belief_.pose.y}, parameters_.reach + 8.0);
  if (!given_.empty()) {
    for (const std::size_t index : belief_.landmarks) {
      near_.add({}, points_on(graph_.landmarks()[index]));
    }
    return;
  }
  for (const std::size_t k :
       keyframes_around(graph_, belief_.pose, base_keyframe_, parameters_.reach)) {
    near_.add(graph_.keyframes()[k].pose, clouds_[k]);
  }
}

}  // namespace quoin
