// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "core/mapping/line_landmark.hpp"
#include "core/mapping/motion.hpp"

namespace quoin {

/// A line of the scan and the place of its wall in a WallBelief.
using WallPairs = std::vector<std::pair<std::size_t, std::size_t>>;

/// Pose and walls around with their joint covariance: the state of an extended Kalman filter. The
/// functions below take all landmarks of the map as `map`, from which the belief holds some.
struct WallBelief {
  Pose2 pose;
  std::vector<std::size_t> landmarks;  ///< of the map
  std::vector<Eigen::Vector2d> walls;  ///< (phi [rad], offset [m]) of each
  Eigen::MatrixXd covariance;          ///< of (x, y, theta, phi, offset, phi, offset, ...)

  /// The landmark at this place, as it is believed to lie.
  [[nodiscard]] LineLandmark wall(std::span<const LineLandmark> map, std::size_t place) const;
  /// Leaves walls out that are not alive.
  void forget_merged(std::span<const LineLandmark> map);

  template <class Archive, class Self>
  static void transfer(Archive& archive, Self& self) {
    archive(self.pose, self.landmarks, self.walls, self.covariance);
  }
};

/// The belief after a motion in the frame of its pose.
[[nodiscard]] WallBelief predict(const WallBelief& belief, const PoseEstimate& motion);

/// Covariance of the residual of a wall at this place of the joint covariance, with the noise of
/// the measurement: S = H P H' + R.
[[nodiscard]] Eigen::Matrix2d innovation_covariance(const LineResidual& residual,
                                                    const Eigen::MatrixXd& covariance,
                                                    std::size_t place,
                                                    const Eigen::Matrix2d& noise);

/// Whether enough of a segment lies on a wall to be of it: walls that end are different walls from
/// others farther on in the same line. `along_stddev` [m] is that of the position.
[[nodiscard]] bool lies_on(const Pose2& pose, const LineLandmark& landmark,
                           const LineMeasurement& measurement, double along_stddev);

/// Updates the belief with one line of a wall that it holds.
void update_with(WallBelief& belief, std::span<const LineLandmark> map, std::size_t place,
                 const LineMeasurement& measurement);

/// Iterated update with all pairs, large residuals weakened. Pairs that the posterior does not
/// explain are dropped. False when nothing is left; the posterior is the prior then.
bool update_with(const WallBelief& prior, std::span<const LineLandmark> map,
                 std::span<const LineMeasurement> measurements, WallPairs& pairs,
                 WallBelief& posterior);

/// Adds a new landmark of the map, made from a measurement at the pose of the belief.
void append_wall(WallBelief& belief, std::size_t index, const LineLandmark& landmark,
                 const LineMeasurement& measurement);

}  // namespace quoin
