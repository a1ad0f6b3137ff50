// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include <Eigen/Core>

#include "core/geometry/line.hpp"
#include "core/geometry/pose.hpp"

namespace quoin {

/// A line of a scan as a measurement: about the middle of its segment direction and offset are
/// nearly uncorrelated, and a small error of the one does not move the other.
struct LineMeasurement {
  double alpha = 0.0;  ///< [rad] direction of the normal away from the sensor
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();  ///< [m] of the segment
  double half_length = 0.0;                          ///< [m]
  /// Of (alpha [rad], offset of the middle along the normal [m]).
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();

  template <class Archive, class Self>
  static void transfer(Archive& archive, Self& self) {
    archive(self.alpha, self.middle, self.half_length, self.covariance);
  }
};

/// Of a line as it was fitted. `flatness_stddev` [m] is what its covariance does not hold yet of
/// how far walls are off a line by themselves (`flatness_covariance`).
[[nodiscard]] LineMeasurement line_measurement(const LineSegment& line, double flatness_stddev);

/// A wall of the map: normal(phi) . (p - anchor) = offset. The normal points away from the side
/// from which the wall is seen: the two faces of a thin wall are two landmarks.
struct LineLandmark {
  Eigen::Vector2d anchor = Eigen::Vector2d::Zero();  ///< [m] fixed
  double phi = 0.0;                                  ///< [rad] direction of the normal
  double offset = 0.0;                               ///< [m]
  double low = 0.0;              ///< [m] extent along (-sin phi, cos phi) from the anchor
  double high = 0.0;             ///< [m]
  std::size_t observations = 0;  ///< keyframes that see it
  std::size_t first_keyframe = 0;
  std::size_t last_keyframe = 0;
  bool alive = true;  ///< false when it was merged into another one

  [[nodiscard]] Eigen::Vector2d normal() const { return {std::cos(phi), std::sin(phi)}; }
  [[nodiscard]] Eigen::Vector2d along() const { return {-std::sin(phi), std::cos(phi)}; }
  [[nodiscard]] Eigen::Vector2d at(double s) const {
    return anchor + offset * normal() + s * along();
  }
  [[nodiscard]] double length() const { return high - low; }

  template <class Archive, class Self>
  static void transfer(Archive& archive, Self& self) {
    archive(self.anchor, self.phi, self.offset, self.low, self.high, self.observations,
            self.first_keyframe, self.last_keyframe, self.alive);
  }
};

/// Measured less expected: of the direction [rad] and of the offset at the middle [m], with
/// derivatives by the pose (x, y, theta) and by the landmark (phi, offset).
struct LineResidual {
  Eigen::Vector2d value;
  Eigen::Matrix<double, 2, 3> by_pose;
  Eigen::Matrix2d by_landmark;
};
[[nodiscard]] LineResidual line_residual(const Pose2& pose, const LineLandmark& landmark,
                                         const LineMeasurement& measurement);

/// Length [m] of the measured segment that lies on the landmark's; negative, the gap between them.
[[nodiscard]] double overlap(const Pose2& pose, const LineLandmark& landmark,
                             const LineMeasurement& measurement);

/// The landmark that a measurement makes, its anchor being the middle as seen from `pose`.
[[nodiscard]] LineLandmark landmark_of(const Pose2& pose, const LineMeasurement& measurement);

/// Lengthens the landmark to what is measured.
void extend(LineLandmark& landmark, const Pose2& pose, const LineMeasurement& measurement);

}  // namespace quoin
