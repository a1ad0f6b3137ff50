// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
//
// What the fits sum over points (moments and the covariance that noise gives) and the 2x2 algebra
// that follows.
#pragma once

#include <algorithm>
#include <optional>

#include <Eigen/Core>

#include "core/sensor/points.hpp"

namespace quoin {

/// Symmetric 2x2 matrix.
struct Symmetric2 {
  double xx = 0.0;
  double xy = 0.0;
  double yy = 0.0;
};

/// Solution of M x = v.
struct Solution2x2 {
  Eigen::Vector2d x;
  Symmetric2 inverse;  ///< M^-1
};

/// Nothing when M is singular to rounding.
[[nodiscard]] inline std::optional<Solution2x2> solve2x2(const Symmetric2& m,
                                                         const Eigen::Vector2d& v) {
  // For a sum of outer products det M is the sum over pairs of squared cross products, so that it
  // is compared with what rounding leaves of M's own products; NaN fails the comparison.
  constexpr double rounding = 1e-13;
  const double determinant = m.xx * m.yy - m.xy * m.xy;
  const double half_trace = 0.5 * (m.xx + m.yy);
  if (!(determinant > rounding * half_trace * half_trace)) return std::nullopt;
  const double scale = 1.0 / determinant;
  const Symmetric2 inverse{m.yy * scale, -m.xy * scale, m.xx * scale};
  return Solution2x2{
      {inverse.xx * v.x() + inverse.xy * v.y(), inverse.xy * v.x() + inverse.yy * v.y()}, inverse};
}

/// Weighted sums of points up to the second order, about an origin; they add and subtract.
struct Moments {
  double weight = 0.0;
  double x = 0.0;   ///< [m] times weight, as all below
  double y = 0.0;   ///< [m]
  double xx = 0.0;  ///< [m^2]
  double xy = 0.0;  ///< [m^2]
  double yy = 0.0;  ///< [m^2]

  void add(double px, double py, double w = 1.0) {
    weight += w;
    x += w * px;
    y += w * py;
    xx += w * px * px;
    xy += w * px * py;
    yy += w * py * py;
  }
  Moments& operator+=(const Moments& other) {
    weight += other.weight;
    x += other.x;
    y += other.y;
    xx += other.xx;
    xy += other.xy;
    yy += other.yy;
    return *this;
  }
  Moments& operator-=(const Moments& other) {
    weight -= other.weight;
    x -= other.x;
    y -= other.y;
    xx -= other.xx;
    xy -= other.xy;
    yy -= other.yy;
    return *this;
  }
};

/// The same about the mean, which is what has a direction.
struct CentralMoments {
  double weight = 0.0;
  double mean_x = 0.0;  ///< [m]
  double mean_y = 0.0;  ///< [m]
  Symmetric2 scatter;   ///< weighted sums of the products of (x, y) about the mean [m^2]

  CentralMoments() = default;
  /// From the moments about the origin (x, y) [m].
  explicit CentralMoments(const Moments& m, double x = 0.0, double y = 0.0) : weight(m.weight) {
    const double scale = 1.0 / weight;
    const double dx = m.x * scale;
    const double dy = m.y * scale;
    mean_x = x + dx;
    mean_y = y + dy;
    scatter = {m.xx - weight * dx * dx, m.xy - weight * dx * dy, m.yy - weight * dy * dy};
  }

  [[nodiscard]] double trace() const { return scatter.xx + scatter.yy; }

  /// Whether the points lie apart by more than rounding leaves of equal ones.
  [[nodiscard]] bool have_extent() const {
    return trace() > 1e-18 * weight * (mean_x * mean_x + mean_y * mean_y);
  }
};

enum class PointWeights {
  equal,
  inverse_square_range,  ///< 1 / range^2 [1/m^2]
};

/// Summed about the first point, which keeps the digits of far walls. At least one point.
[[nodiscard]] CentralMoments central_moments(const PointsView& points, PointWeights weights);

/// Variances to weight points with. A sensor model may say that there is no noise; a range is never
/// taken to be better than a micrometre nor a bearing than a nanoradian, so that the weights stay
/// finite.
struct WeightVariances {
  double range;         ///< [m^2] the part that all ranges have
  double range_growth;  ///< without unit: times the squared range, the part that grows with it
  double bearing;       ///< [rad^2]

  explicit WeightVariances(const SensorModel& sensor)
      : range(std::max(sensor.range_stddev * sensor.range_stddev, 1e-12)),
        range_growth(sensor.range_stddev_per_metre * sensor.range_stddev_per_metre),
        bearing(std::max(sensor.bearing_stddev * sensor.bearing_stddev, 1e-18)) {}

  /// [m^2] of a range whose square is `squared_range` [m^2].
  [[nodiscard]] double range_at(double squared_range) const {
    return range + range_growth * squared_range;
  }

  /// The same variance for all ranges: that of the point in the middle. What a paper weights its
  /// points with knows no other.
  [[nodiscard]] static WeightVariances of_middle(const SensorModel& sensor,
                                                 const PointsView& points) {
    WeightVariances variances(sensor);
    if (points.size() > 0) {
      const double range = points.range[points.size() / 2];
      variances.range = variances.range_at(range * range);
    }
    variances.range_growth = 0.0;
    return variances;
  }
};

/// Derivatives of two quantities x and y with respect to the range and the bearing of one point.
struct PointJacobian {
  double range_x = 0.0;
  double range_y = 0.0;
  double bearing_x = 0.0;
  double bearing_y = 0.0;

  PointJacobian& operator+=(const PointJacobian& other) {
    range_x += other.range_x;
    range_y += other.range_y;
    bearing_x += other.bearing_x;
    bearing_y += other.bearing_y;
    return *this;
  }
};

/// Adds J diag(range_variance, bearing_variance) J', the contribution of the noise of the point to
/// the covariance of (x, y).
inline void add_noise(Symmetric2& covariance, const PointJacobian& j, double range_variance,
                      double bearing_variance) {
  covariance.xx +=
      range_variance * j.range_x * j.range_x + bearing_variance * j.bearing_x * j.bearing_x;
  covariance.xy +=
      range_variance * j.range_x * j.range_y + bearing_variance * j.bearing_x * j.bearing_y;
  covariance.yy +=
      range_variance * j.range_y * j.range_y + bearing_variance * j.bearing_y * j.bearing_y;
}

/// Covariance of (alpha, r) from that of (alpha, offset of the line at a point), where t is the
/// coordinate of that point along the line [m]: dr = d(offset) + t d(alpha).
[[nodiscard]] inline Eigen::Matrix2d from_offset_at(const Symmetric2& covariance, double t) {
  Eigen::Matrix2d result;
  result(0, 0) = covariance.xx;
  result(0, 1) = covariance.xy + t * covariance.xx;
  result(1, 0) = result(0, 1);
  result(1, 1) = covariance.yy + 2.0 * t * covariance.xy + t * t * covariance.xx;
  return result;
}

}  // namespace quoin
