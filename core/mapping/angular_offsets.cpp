// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/mapping/angular_offsets.hpp"

#include <algorithm>
#include <cmath>

#include "core/geometry/angle.hpp"

namespace quoin {
namespace {

/// Our copy of the paper hides its equation 13: any weight that falls with the distance is in its
/// sense. Nearer than this [m] all matches count alike.
constexpr double nearest_distance = 0.01;

/// How far from constant velocity a robot gets in a second.
constexpr double acceleration_stddev = 1.0;       // [m/s^2]
constexpr double turn_acceleration_stddev = 2.0;  // [rad/s^2]

PoseEstimate at_constant_velocity(const Eigen::Vector3d& velocity, double seconds) {
  PoseEstimate increment{after_twist(velocity, seconds), {}};
  const double half_square = 0.5 * seconds * seconds;
  const double position = acceleration_stddev * half_square;
  const double heading = turn_acceleration_stddev * half_square;
  increment.covariance =
      Eigen::Vector3d(position * position, position * position, heading * heading).asDiagonal();
  return increment;
}

}  // namespace

AngularOffsets::AngularOffsets(const Parameters& parameters)
    : map_(parameters.largest_angle, parameters.largest_distance) {}

void AngularOffsets::operator()(const LocalizationInput& input, Localization& result) {
  const double seconds = stamp_ ? input.stamp - *stamp_ : 0.0;
  PoseEstimate increment;
  if (stamp_) increment = input.motion.value_or(at_constant_velocity(velocity_, seconds));
  const PoseEstimate previous = pose_;
  PoseEstimate predicted = compose(previous, increment);

  double weights = 0.0, offsets = 0.0, variance = 0.0;
  result.matched = 0;
  matches_.clear();
  for (const LineSegment& line : input.lines) {
    const std::optional<LineMatch>& match = matches_.emplace_back(
        map_.find(predicted.pose.transform(line.start), predicted.pose.transform(line.end)));
    if (!match) continue;
    const double weight = 1.0 / std::max(match->distance, nearest_distance);
    weights += weight;
    offsets += weight * match->angle_offset;
    // The stored direction is that of one scan, so it has about the same error once more.
    variance += 2.0 * weight * weight * line.estimate.covariance(0, 0);
    ++result.matched;
  }
  if (weights > 0.0) {
    // Eq. 12: the heading. Eq. 14: the position again, from the previous one with the corrected
    // heading.
    const double correction = offsets / weights;
    Pose2 from = previous.pose;
    from.theta = normalized_angle(from.theta + correction);
    predicted.pose = compose(from, increment.pose);
    const double heading = variance / (weights * weights);
    predicted.covariance.row(2).head<2>().setZero();
    predicted.covariance.col(2).head<2>().setZero();
    predicted.covariance(2, 2) = heading;
  }
  for (std::size_t i = 0; i < input.lines.size() && !is_given_; ++i) {
    const Eigen::Vector2d start = predicted.pose.transform(input.lines[i].start);
    const Eigen::Vector2d end = predicted.pose.transform(input.lines[i].end);
    // Lines of one scan do not match each other: what was no match before is new.
    if (matches_[i]) {
      map_.extend(matches_[i]->index, start, end);
    } else {
      map_.add(start, end);
    }
  }
  if (seconds > 0.0) {
    velocity_ = twist_of(between(previous.pose, predicted.pose)) / seconds;
  }
  pose_ = predicted;
  stamp_ = input.stamp;

  result.pose = pose_;
  const bool is_first = !is_given_ && map_.lines().size() == input.lines.size();
  result.status = !has_pose_                  ? LocalizationStatus::lost
                  : weights > 0.0 || is_first ? LocalizationStatus::tracking
                                              : LocalizationStatus::ambiguous;
  result.weak_direction.reset();
  result.keyframe.reset();
  result.map.clear();
  if (input.wants_map) result.map.assign(map_.lines().begin(), map_.lines().end());
}

void AngularOffsets::use_map(std::span<const MapLine> map,
                             const std::optional<PoseEstimate>& pose) {
  reset();
  for (const MapLine& line : map) map_.add(line);
  is_given_ = true;
  has_pose_ = pose.has_value();
  if (pose) pose_ = *pose;
}

void AngularOffsets::reset() {
  map_.clear();
  pose_ = {};
  velocity_.setZero();
  stamp_.reset();
  is_given_ = false;
  has_pose_ = true;
}

}  // namespace quoin
