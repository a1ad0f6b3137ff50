// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/mapping/motion.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "core/geometry/angle.hpp"

namespace quoin {
namespace {

/// The mean of the rotations from 0 to `angle`: [a, -b; b, a].
struct MeanRotation {
  double a = 1.0;
  double b = 0.0;

  explicit MeanRotation(double angle) {
    if (std::abs(angle) < 1e-6) {
      a = 1.0 - angle * angle / 6.0;
      b = 0.5 * angle;
    } else {
      a = std::sin(angle) / angle;
      b = (1.0 - std::cos(angle)) / angle;
    }
  }
};

/// Replaces each ray by the one from the pose at the first ray, `pose_at(offset)` being the pose
/// after so many seconds in the frame of that one.
template <class PoseAt>
void deskew_rays(const PoseAt& pose_at, std::span<const float> time_offsets,
                 std::span<float> bearings, std::span<float> ranges) {
  const std::size_t count = std::min({time_offsets.size(), bearings.size(), ranges.size()});
  double travelled = 0.0;  // signed turn from the first valid ray
  double last = 0.0;
  bool first = true;
  for (std::size_t i = 0; i < count; ++i) {
    const double range = ranges[i];
    const double bearing = bearings[i];
    if (!std::isfinite(range) || !std::isfinite(bearing) || range <= 0.0) continue;
    const Eigen::Vector2d point =
        pose_at(static_cast<double>(time_offsets[i]))
            .transform({range * std::cos(bearing), range * std::sin(bearing)});
    const double corrected = std::atan2(point.y(), point.x());
    if (!first) travelled += normalized_angle(corrected - last);
    first = false;
    last = corrected;
    bearings[i] = static_cast<float>(corrected);
    ranges[i] = std::abs(travelled) < 2.0 * pi ? static_cast<float>(point.norm())
                                               : std::numeric_limits<float>::quiet_NaN();
  }
}

}  // namespace

Pose2 compose(const Pose2& first, const Pose2& second) {
  const Eigen::Vector2d position = first.transform({second.x, second.y});
  return {position.x(), position.y(), normalized_angle(first.theta + second.theta)};
}

Pose2 between(const Pose2& from, const Pose2& to) {
  const Eigen::Vector2d position = from.inverse_transform({to.x, to.y});
  return {position.x(), position.y(), normalized_angle(to.theta - from.theta)};
}

Eigen::Matrix3d compose_by_first(const Pose2& first, const Pose2& second) {
  const double c = std::cos(first.theta);
  const double s = std::sin(first.theta);
  Eigen::Matrix3d jacobian = Eigen::Matrix3d::Identity();
  jacobian(0, 2) = -s * second.x - c * second.y;
  jacobian(1, 2) = c * second.x - s * second.y;
  return jacobian;
}

Eigen::Matrix3d compose_by_second(const Pose2& first) {
  const double c = std::cos(first.theta);
  const double s = std::sin(first.theta);
  Eigen::Matrix3d jacobian = Eigen::Matrix3d::Identity();
  jacobian.topLeftCorner<2, 2>() << c, -s, s, c;
  return jacobian;
}

Pose2 moved(const Pose2& pose, const Eigen::Vector3d& change) {
  return {pose.x + change.x(), pose.y + change.y(), normalized_angle(pose.theta + change.z())};
}

Eigen::Matrix3d covariance_in_frame(const Pose2& frame, const Eigen::Matrix3d& covariance) {
  const double c = std::cos(frame.theta);
  const double s = std::sin(frame.theta);
  Eigen::Matrix3d turn;
  turn << c, s, 0.0, -s, c, 0.0, 0.0, 0.0, 1.0;
  return turn * covariance * turn.transpose();
}

PoseEstimate compose(const PoseEstimate& first, const PoseEstimate& increment) {
  const Eigen::Matrix3d by_first = compose_by_first(first.pose, increment.pose);
  const Eigen::Matrix3d by_second = compose_by_second(first.pose);
  return {compose(first.pose, increment.pose),
          by_first * first.covariance * by_first.transpose() +
              by_second * increment.covariance * by_second.transpose()};
}

Pose2 after_twist(const Eigen::Vector3d& velocity, double seconds) {
  const double angle = velocity.z() * seconds;
  const MeanRotation mean(angle);
  const double x = velocity.x() * seconds;
  const double y = velocity.y() * seconds;
  return {mean.a * x - mean.b * y, mean.b * x + mean.a * y, normalized_angle(angle)};
}

Eigen::Vector3d twist_of(const Pose2& increment) {
  const MeanRotation mean(increment.theta);
  const double determinant = mean.a * mean.a + mean.b * mean.b;
  return {(mean.a * increment.x + mean.b * increment.y) / determinant,
          (mean.a * increment.y - mean.b * increment.x) / determinant, increment.theta};
}

Pose2 interpolate(const Pose2& from, const Pose2& to, double fraction) {
  return compose(from, after_twist(twist_of(between(from, to)), fraction));
}

Eigen::Matrix3d OdometryNoise::covariance(const Pose2& increment) const {
  const Eigen::Vector3d twist = twist_of(increment);
  const double driven = std::hypot(twist.x(), twist.y());
  const double along = translation_per_metre * driven;
  const double across = sideways_per_metre * driven;
  const double per_metre = heading_per_metre * driven;
  const double per_radian = heading_per_radian * increment.theta;
  const double floor = translation_floor * translation_floor;
  // Along and across the path, whose direction in the middle is half the turn on.
  const double direction = driven > 0.0 ? std::atan2(increment.y, increment.x) : 0.0;
  const Eigen::Vector2d ahead(std::cos(direction), std::sin(direction));
  const Eigen::Vector2d aside(-ahead.y(), ahead.x());
  const double heading = per_metre * per_metre + per_radian * per_radian;
  Eigen::Matrix3d result = Eigen::Matrix3d::Zero();
  result.topLeftCorner<2, 2>() = along * along * ahead * ahead.transpose() +
                                 across * across * aside * aside.transpose() +
                                 floor * Eigen::Matrix2d::Identity();
  // An error of the heading that grows evenly on the way moves the end by half of it.
  const Eigen::Vector3d lever(-0.5 * increment.y, 0.5 * increment.x, 1.0);
  result += heading * lever * lever.transpose();
  result(2, 2) += heading_floor * heading_floor;
  return result;
}

bool OdometryTrack::add(double stamp, const Pose2& pose) {
  if (!std::isfinite(stamp) || (!poses_.empty() && stamp <= poses_.back().stamp)) return false;
  poses_.push_back({stamp, pose});
  return true;
}

void OdometryTrack::forget_before(double stamp) {
  const auto after = std::upper_bound(poses_.begin(), poses_.end(), stamp,
                                      [](double t, const Stamped& s) { return t < s.stamp; });
  if (after - poses_.begin() > 1) poses_.erase(poses_.begin(), after - 1);
}

std::optional<Pose2> OdometryTrack::at(double stamp) const {
  const auto after = std::lower_bound(poses_.begin(), poses_.end(), stamp,
                                      [](const Stamped& s, double t) { return s.stamp < t; });
  if (after == poses_.end()) return std::nullopt;
  if (after->stamp == stamp) return after->pose;
  if (after == poses_.begin()) return std::nullopt;
  const Stamped& before = *(after - 1);
  const double fraction = (stamp - before.stamp) / (after->stamp - before.stamp);
  return interpolate(before.pose, after->pose, fraction);
}

std::optional<PoseEstimate> OdometryTrack::increment(double from, double to,
                                                     const OdometryNoise& noise) const {
  const std::optional<Pose2> start = at(from);
  const std::optional<Pose2> end = at(to);
  if (!start || !end) return std::nullopt;
  const Pose2 increment = between(*start, *end);
  return PoseEstimate{increment, noise.covariance(increment)};
}

void deskew(const Eigen::Vector3d& velocity, std::span<const float> time_offsets,
            std::span<float> bearings, std::span<float> ranges) {
  deskew_rays([&](double offset) { return after_twist(velocity, offset); }, time_offsets, bearings,
              ranges);
}

bool deskew(const OdometryTrack& track, double stamp, std::span<const float> time_offsets,
            std::span<float> bearings, std::span<float> ranges) {
  if (time_offsets.empty()) return true;
  const auto [earliest, latest] = std::minmax_element(time_offsets.begin(), time_offsets.end());
  const std::optional<Pose2> start = track.at(stamp);
  if (!start || !track.at(stamp + static_cast<double>(*earliest)) ||
      !track.at(stamp + static_cast<double>(*latest))) {
    return false;
  }
  deskew_rays(
      [&](double offset) { return between(*start, track.at(stamp + offset).value_or(*start)); },
      time_offsets, bearings, ranges);
  return true;
}

}  // namespace quoin
