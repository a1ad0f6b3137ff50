// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

#include <Eigen/Core>

#include "core/circles/circle_fit.hpp"
#include "core/sensor/points.hpp"
#include "core/simulation/random.hpp"
#include "core/statistics/interval.hpp"

namespace quoin {

/// A round thing that a sensor of evenly spaced rays sees: from outside its near side, from inside
/// what lies in the field of view.
struct ArcScene {
  double radius = 0.0;               ///< [m]
  double distance = 0.0;             ///< [m] of the centre from the sensor; inside when < radius
  double field = 6.283185307179586;  ///< [rad] of view, about the direction to the centre
  std::size_t rays = 920;            ///< a revolution

  [[nodiscard]] bool concave() const { return distance < radius; }
};

/// The points of the scene without noise, the centre in the direction `direction` [rad]; the first
/// ray is `phase` (0 to 1) of a spacing off a multiple of it. Nothing behind the centre of a small
/// round room is left out.
void observe(const ArcScene& scene, double direction, double phase, Points& points);

/// Smallest covariance of (x, y, radius) [m^2] that any unbiased fit of `circle` to points at these
/// places can have: the inverse of the Fisher information, the sum of g g^T / v over the points,
/// with g = (normal, 1) and v the variance of the distance from the circle. `points` are without
/// noise and at least three.
[[nodiscard]] Eigen::Matrix3d cramer_rao_bound(const Circle& circle, const PointsView& points,
                                               const SensorModel& noise);

/// How true the covariances of one fitter are for one round thing with one noise.
struct CircleConsistency {
  std::size_t trials = 0;
  double points = 0.0;         ///< mean number
  double nonlinearity = 0.0;   ///< of a circle without noise: CircleFit::nonlinearity
  Interval nees;               ///< mean squared Mahalanobis distance of the three; 3 is right
  Interval coverage95;         ///< of the 95 % ellipsoid of centre and radius
  Interval coverage95_center;  ///< of the 95 % ellipse of the centre
  Interval rmse_over_crb;      ///< of the centre, spread taken from batches of the trials
  Interval radius_rmse_over_crb;
  CircleFailureCounts failures{};
};

/// Monte Carlo: in every trial the direction and the phase of the rays are drawn anew, and the
/// noise of each. Same seed, same result.
[[nodiscard]] CircleConsistency judge_circle_consistency(const CircleFitter& fitter,
                                                         const ArcScene& scene,
                                                         const SensorModel& noise,
                                                         std::size_t trials, std::uint64_t seed);

}  // namespace quoin
