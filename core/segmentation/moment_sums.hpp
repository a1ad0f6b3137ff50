// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "core/segmentation/tolerance.hpp"
#include "core/sensor/points.hpp"

namespace quoin {

/// Weighted sums of points up to the second order; they add and subtract.
struct MomentSums {
  double weight = 0.0;
  double x = 0.0;   ///< [m]
  double y = 0.0;   ///< [m]
  double xx = 0.0;  ///< [m^2]
  double xy = 0.0;  ///< [m^2]
  double yy = 0.0;  ///< [m^2]

  void add(double px, double py, double point_weight = 1.0) {
    weight += point_weight;
    x += point_weight * px;
    y += point_weight * py;
    xx += point_weight * px * px;
    xy += point_weight * px * py;
    yy += point_weight * py * py;
  }
  MomentSums& operator+=(const MomentSums& other);
  MomentSums& operator-=(const MomentSums& other);
};

/// Total least squares line with the principal variances of its points.
struct OrthogonalFit {
  NormalLine line;
  double x = 0.0;       ///< [m] centroid
  double y = 0.0;       ///< [m]
  double along = 0.0;   ///< [m^2] variance along the line, the larger eigenvalue
  double across = 0.0;  ///< [m^2] variance across it; cleared of negative rounding
};

/// Nothing when the points have no direction: fewer than two, equal, or spread alike to all sides.
[[nodiscard]] std::optional<OrthogonalFit> orthogonal_fit(const MomentSums& moments);

/// A tolerance is at least so many standard deviations (the default noise_factor); walls that are
/// not as straight as a line are given the same margin.
inline constexpr double deviations_in_tolerance = 4.0;

/// One line for two sets of points.
struct JointFit {
  OrthogonalFit fit;
  double distance = 0.0;  ///< squared Mahalanobis distance of the two lines
};

/// For equal noise the distance is how much the sum of squared residuals rises, in variances, when
/// one line must serve both; chi square with two degrees of freedom when they are the same.
[[nodiscard]] std::optional<JointFit> joint_fit(const MomentSums& first, const MomentSums& second,
                                                const Tolerance& tolerance);

/// Running sums over the points of a scan, which give the moments of any run of them at once.
class PrefixMoments {
 public:
  void assign(const PointsView& points);

  /// Of points [begin, end).
  [[nodiscard]] MomentSums operator()(std::size_t begin, std::size_t end) const;

 private:
  std::vector<MomentSums> sums_;  // of the points before i
};

}  // namespace quoin
