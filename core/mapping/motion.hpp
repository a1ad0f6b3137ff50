// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "core/geometry/pose.hpp"

namespace quoin {

/// A pose with the covariance of (x, y, theta), 3x3 [m^2, m rad, rad^2]. The errors are those of
/// the components, in the frame that the pose is given in.
struct PoseEstimate {
  Pose2 pose;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();

  template <class Archive, class Self>
  static void transfer(Archive& archive, Self& self) {
    archive(self.pose, self.covariance);
  }
};

/// The pose that is `second` in the frame of `first`.
[[nodiscard]] Pose2 compose(const Pose2& first, const Pose2& second);

/// `to` in the frame of `from`: compose(from, between(from, to)) is `to`.
[[nodiscard]] Pose2 between(const Pose2& from, const Pose2& to);

/// Derivatives of compose(first, second), 3x3, by the components of `first` and of `second`.
[[nodiscard]] Eigen::Matrix3d compose_by_first(const Pose2& first, const Pose2& second);
[[nodiscard]] Eigen::Matrix3d compose_by_second(const Pose2& first);

/// The pose with this added to its components.
[[nodiscard]] Pose2 moved(const Pose2& pose, const Eigen::Vector3d& change);

/// A covariance of (x, y, theta) in the frame of a pose, of one in the frame that the pose is given
/// in.
[[nodiscard]] Eigen::Matrix3d covariance_in_frame(const Pose2& frame,
                                                  const Eigen::Matrix3d& covariance);

/// The pose after an increment whose error is independent of that of `first`, to first order.
[[nodiscard]] PoseEstimate compose(const PoseEstimate& first, const PoseEstimate& increment);

/// Where the sensor is after a constant twist, as the arc of a circle. `velocity` is [m/s] in the
/// moving frame and [rad/s].
[[nodiscard]] Pose2 after_twist(const Eigen::Vector3d& velocity, double seconds);

/// The constant twist that leads to `increment` in one second; the inverse of `after_twist`.
[[nodiscard]] Eigen::Vector3d twist_of(const Pose2& increment);

/// On the way from one pose to the other at a constant twist; `fraction` is 0 at the first.
[[nodiscard]] Pose2 interpolate(const Pose2& from, const Pose2& to, double fraction);

/// Standard deviations of wheel odometry, as parts of what was driven. The errors of different
/// increments are taken as independent.
struct OdometryNoise {
  double translation_per_metre = 0.02;  ///< slip, along the path
  double sideways_per_metre = 0.01;     ///< across the path
  double heading_per_metre = 0.01;      ///< [rad/m]
  double heading_per_radian = 0.03;     ///< of turning
  double translation_floor = 0.001;     ///< [m] of each increment
  double heading_floor = 0.0005;        ///< [rad] of each increment
  /// The covariance of an increment, 3x3, in the frame of its start.
  [[nodiscard]] Eigen::Matrix3d covariance(const Pose2& increment) const;
};

/// Odometry by its stamps, from which poses in between are interpolated along constant twists.
class OdometryTrack {
 public:
  /// Stamps [s] ascend; one that does not is left out, and false is returned.
  bool add(double stamp, const Pose2& pose);
  /// Forgets what is before the last pose at or before `stamp`.
  void forget_before(double stamp);
  [[nodiscard]] bool empty() const { return poses_.empty(); }

  /// The pose at `stamp`; nothing outside of the first and the last stamp: nothing is extrapolated.
  [[nodiscard]] std::optional<Pose2> at(double stamp) const;

  /// The increment from one stamp to another with the covariance that `noise` gives it; nothing
  /// when one of them is not covered.
  [[nodiscard]] std::optional<PoseEstimate> increment(double from, double to,
                                                      const OdometryNoise& noise) const;

 private:
  struct Stamped {
    double stamp;
    Pose2 pose;
  };
  std::vector<Stamped> poses_;
};

/// Rays that were cast while the sensor moved, as rays from where it was at the first one: bearings
/// [rad] and ranges [m] are replaced, `time_offsets` [s] are after the first ray. Of a sweep that
/// overlaps itself then, because the sensor turned with the rotation of the rays, what comes after
/// a whole revolution gets the range NaN. Spans of different lengths are used as far as all reach.
///
/// `velocity` is the twist of the sensor, [m/s] in its own frame and [rad/s], constant in the scan.
void deskew(const Eigen::Vector3d& velocity, std::span<const float> time_offsets,
            std::span<float> bearings, std::span<float> ranges);

/// The same with the odometry of the scan, whose first ray was cast at `stamp` [s]. False, with
/// nothing changed, when the odometry does not cover the scan.
bool deskew(const OdometryTrack& track, double stamp, std::span<const float> time_offsets,
            std::span<float> bearings, std::span<float> ranges);

}  // namespace quoin
