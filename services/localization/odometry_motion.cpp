// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/localization/odometry_motion.hpp"

#include <cmath>

#include <Eigen/Eigenvalues>

#include "services/topics/poses.hpp"

namespace quoin {
namespace {

// Between messages farther apart [s] nobody knows what the robot did.
constexpr double longest_gap = 1.0;

double seconds_between(std::int64_t from, std::int64_t to) {
  return (static_cast<double>(to) - static_cast<double>(from)) * 1e-9;
}

/// The covariance of the way between two poses whose errors have grown on it, in the frame of the
/// first; nothing where they have not grown: then they say nothing of it.
std::optional<Eigen::Matrix3d> grown(const PoseEstimate& from, const PoseEstimate& to,
                                     const Pose2& way) {
  const Eigen::Matrix3d by_first = compose_by_first(from.pose, way);
  const Eigen::Matrix3d back = compose_by_second(from.pose).inverse();
  Eigen::Matrix3d covariance =
      back * (to.covariance - by_first * from.covariance * by_first.transpose()) * back.transpose();
  covariance = (0.5 * (covariance + covariance.transpose())).eval();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(covariance);
  // What is left of two large numbers may be a little below zero.
  const double rounding = 1e-9 * to.covariance.trace();
  if (axes.eigenvalues()(0) < -rounding || axes.eigenvalues()(2) <= rounding) return std::nullopt;
  return covariance;
}

}  // namespace

OdometryMotion::OdometryMotion(const RobotParameters& parameters)
    : parameters_(parameters),
      mounting_(parameters.mounting()),
      from_mounting_(between(mounting_, Pose2{})) {
  for (double* stddev :
       {&noise_.translation_per_metre, &noise_.sideways_per_metre, &noise_.heading_per_metre,
        &noise_.heading_per_radian, &noise_.translation_floor, &noise_.heading_floor}) {
    *stddev *= parameters.odometry_noise;
  }
}

std::nullopt_t OdometryMotion::reject(const std::string& why) {
  ++rejected_;
  reason_ = why;
  return std::nullopt;
}

bool OdometryMotion::too_fast(const Pose2& way, double seconds) const {
  // Stamps are those of a computer that may have been busy.
  const double time = seconds + 0.01;
  return std::hypot(way.x, way.y) > parameters_.largest_speed * time ||
         std::abs(way.theta) > parameters_.largest_turn_rate * time;
}

std::optional<OdometryMotion::Instant> OdometryMotion::at(std::int64_t stamp,
                                                          const msg::Odometry* before,
                                                          const msg::Odometry* after) {
  if (before == nullptr || after == nullptr) return std::nullopt;
  if (!topics::valid(before->pose()) || !topics::valid(after->pose())) {
    return reject("a pose that is none");
  }
  const std::int64_t from = before->header().stamp();
  const std::int64_t to = after->header().stamp();
  const PoseEstimate first = topics::pose_estimate(before->pose());
  if (to == from) return Instant{stamp, first, before->header().frame()};
  const double gap = seconds_between(from, to);
  if (gap > longest_gap) return reject("no message for more than a second");
  const PoseEstimate second = topics::pose_estimate(after->pose());
  if (before->header().frame() != after->header().frame()) return reject("another frame");
  if (too_fast(between(first.pose, second.pose), gap)) return reject("it jumps");
  const double fraction = seconds_between(from, stamp) / gap;
  return Instant{stamp,
                 {interpolate(first.pose, second.pose, fraction),
                  (1.0 - fraction) * first.covariance + fraction * second.covariance},
                 before->header().frame()};
}

std::optional<PoseEstimate> OdometryMotion::to_scan(std::int64_t stamp, const msg::Odometry* before,
                                                    const msg::Odometry* after) {
  const std::optional<Instant> now = at(stamp, before, after);
  const std::optional<Instant> last = std::exchange(last_, now);
  if (!now || !last) return std::nullopt;
  const double seconds = seconds_between(last->stamp, now->stamp);
  if (seconds <= 0.0) return reject("the stamps of the scans go back");
  if (last->frame != now->frame) return reject("another frame");
  const Pose2 way = between(last->pose.pose, now->pose.pose);
  if (too_fast(way, seconds)) return reject("it jumps");
  // Of the sensor: from it to the robot, along the way, and to the sensor again.
  const Pose2 to_robot = compose(from_mounting_, way);
  const Pose2 of_sensor = compose(to_robot, mounting_);
  const auto covariance = grown(last->pose, now->pose, way);
  const Eigen::Matrix3d by_way =
      compose_by_first(to_robot, mounting_) * compose_by_second(from_mounting_);
  return PoseEstimate{of_sensor,
                      by_way * covariance.value_or(noise_.covariance(way)) * by_way.transpose()};
}

}  // namespace quoin
