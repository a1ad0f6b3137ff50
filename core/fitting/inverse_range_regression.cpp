// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/fitting/inverse_range_regression.hpp"

#include "core/fitting/point_influence.hpp"
#include "core/sensor/multiversion.hpp"

namespace quoin {
namespace {

QUOIN_MULTIVERSION
void add_up(const double* __restrict cosine, const double* __restrict sine,
            const double* __restrict inverse_range, std::size_t count, InverseRangeSums& out,
            double& infinite) {
  InverseRangeSums sums;
  double zeros = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    const double z = inverse_range[i];
    sums.cc += cosine[i] * cosine[i];
    sums.cs += cosine[i] * sine[i];
    sums.ss += sine[i] * sine[i];
    sums.cz += cosine[i] * z;
    sums.sz += sine[i] * z;
    zeros += z > 0.0 ? 0.0 : 1.0;
  }
  out = sums;
  infinite = zeros;
}

/// Influences of one point on M q, with e the residual of the regression and d the slope of the
/// fitted inverse range z with bearing:
///   range:   -(c, s) z^2            bearing:  (-s, c) e - (c, s) d
/// Exact derivatives: WCTLS eq. (14) and (15) with the weights differentiated, times M / c_w.
inline PointInfluence influence_of(double c, double s, double z, double a, double b) {
  const double e = z - (c * a + s * b);
  const double d = c * b - s * a;
  return {-c * z * z, -s * z * z, -s * e - c * d, c * e - s * d};
}

QUOIN_MULTIVERSION
void add_up_influences(const double* __restrict cosine, const double* __restrict sine,
                       const double* __restrict inverse_range, std::size_t count, double a,
                       double b, double range_variance, double bearing_variance, Symmetric2& out) {
  Symmetric2 sums;
  for (std::size_t i = 0; i < count; ++i) {
    add_noise(sums, influence_of(cosine[i], sine[i], inverse_range[i], a, b), range_variance,
              bearing_variance);
  }
  out = sums;
}

}  // namespace

InverseRangeSums inverse_range_sums(const PointsView& points) {
  InverseRangeSums sums;
  double infinite = 0.0;
  add_up(points.cosine.data(), points.sine.data(), points.inverse_range.data(), points.size(), sums,
         infinite);
  return sums;
}

Symmetric2 inverse_range_influence(const PointsView& points, const Eigen::Vector2d& q,
                                   const SensorModel& sensor) {
  Symmetric2 sums;
  add_up_influences(points.cosine.data(), points.sine.data(), points.inverse_range.data(),
                    points.size(), q.x(), q.y(), sensor.range_stddev * sensor.range_stddev,
                    sensor.bearing_stddev * sensor.bearing_stddev, sums);
  return sums;
}

Symmetric2 inverse_range_common_influence(const PointsView& points, const Eigen::Vector2d& q,
                                          const SensorModel& sensor) {
  PointInfluence sum;
  for (std::size_t i = 0; i < points.size(); ++i) {
    sum += influence_of(points.cosine[i], points.sine[i], points.inverse_range[i], q.x(), q.y());
  }
  Symmetric2 covariance;
  add_noise(covariance, sum, sensor.range_stddev * sensor.range_stddev,
            sensor.bearing_stddev * sensor.bearing_stddev);
  return covariance;
}

FitFailure solve_inverse_range(const PointsView& points, InverseLine& line) {
  if (points.size() < 2) return FitFailure::too_few_points;
  InverseRangeSums sums;
  double infinite = 0.0;
  add_up(points.cosine.data(), points.sine.data(), points.inverse_range.data(), points.size(), sums,
         infinite);
  // The inverse of an infinite range is 0 and would pass for a measurement.
  if (infinite > 0.0) return FitFailure::not_finite;
  const auto solved = solve_inverse_line({sums.cc, sums.cs, sums.ss}, sums.cz, sums.sz);
  if (!solved) return reason_of_singularity(points);
  line = *solved;
  return FitFailure::none;
}

FitResult fit_inverse_range(const PointsView& points, const SensorModel& sensor,
                            CountedErrors counted) {
  InverseLine line;
  const FitFailure failure = solve_inverse_range(points, line);
  if (failure != FitFailure::none) return FitResult::failed(failure);
  if (counted == CountedErrors::common) {
    return to_normal_form(line, inverse_range_common_influence(points, line.q, sensor));
  }
  Symmetric2 influence = inverse_range_influence(points, line.q, sensor);
  if (counted == CountedErrors::independent_and_bias) {
    add_bearing_bias(line, sensor.bearing_stddev * sensor.bearing_stddev, influence);
  }
  return to_normal_form(line, influence);
}

}  // namespace quoin
