// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/mapping/line_landmark.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/fitting/fit.hpp"
#include "core/geometry/angle.hpp"

namespace quoin {
namespace {

/// The ends of the measured segment along the landmark, from its anchor, ascending [m].
std::pair<double, double> extent(const Pose2& pose, const LineLandmark& landmark,
                                 const LineMeasurement& measurement) {
  const Eigen::Vector2d tangent(-std::sin(measurement.alpha), std::cos(measurement.alpha));
  const Eigen::Vector2d half = measurement.half_length * tangent;
  const Eigen::Vector2d along = landmark.along();
  const double first = along.dot(pose.transform(measurement.middle - half) - landmark.anchor);
  const double second = along.dot(pose.transform(measurement.middle + half) - landmark.anchor);
  return std::minmax(first, second);
}

}  // namespace

LineMeasurement line_measurement(const LineSegment& line, double flatness_stddev) {
  LineMeasurement result;
  result.alpha = line.estimate.line.alpha;
  result.middle = 0.5 * (line.start + line.end);
  const double length = (line.end - line.start).norm();
  result.half_length = 0.5 * length;
  const Eigen::Vector2d normal = line.estimate.line.normal();
  const double along = normal.x() * result.middle.y() - normal.y() * result.middle.x();
  result.covariance =
      line.estimate.about(along).covariance + flatness_covariance(flatness_stddev, length);
  return result;
}

LineResidual line_residual(const Pose2& pose, const LineLandmark& landmark,
                           const LineMeasurement& measurement) {
  const Eigen::Vector2d normal = landmark.normal();
  const Eigen::Vector2d point = pose.transform(measurement.middle);
  const Eigen::Vector2d lever(-(point.y() - pose.y), point.x() - pose.x);
  const Eigen::Vector2d from_anchor = point - landmark.anchor;
  LineResidual result;
  result.value << normalized_angle(pose.theta + measurement.alpha - landmark.phi),
      normal.dot(from_anchor) - landmark.offset;
  result.by_pose << 0.0, 0.0, 1.0, normal.x(), normal.y(), normal.dot(lever);
  result.by_landmark << -1.0, 0.0, landmark.along().dot(from_anchor), -1.0;
  return result;
}

double overlap(const Pose2& pose, const LineLandmark& landmark,
               const LineMeasurement& measurement) {
  const auto [first, last] = extent(pose, landmark, measurement);
  return std::min(last, landmark.high) - std::max(first, landmark.low);
}

LineLandmark landmark_of(const Pose2& pose, const LineMeasurement& measurement) {
  LineLandmark result;
  result.anchor = pose.transform(measurement.middle);
  result.phi = normalized_angle(pose.theta + measurement.alpha);
  result.low = -measurement.half_length;
  result.high = measurement.half_length;
  return result;
}

void extend(LineLandmark& landmark, const Pose2& pose, const LineMeasurement& measurement) {
  const auto [first, last] = extent(pose, landmark, measurement);
  landmark.low = std::min(landmark.low, first);
  landmark.high = std::max(landmark.high, last);
}

}  // namespace quoin
