// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/fitting/inverse_range_regression.hpp"

#include "core/fitting/point_influence.hpp"
#include "core/sensor/multiversion.hpp"

namespace quoin {
namespace {

template <class Count>
[[gnu::always_inline]] inline InverseRangeSums add_up(const double* __restrict cosine,
                                                      const double* __restrict sine,
                                                      const double* __restrict inverse_range,
                                                      std::size_t count, const Count& also_count) {
  InverseRangeSums sums;
  for (std::size_t i = 0; i < count; ++i) {
    const double z = inverse_range[i];
    sums.cc += cosine[i] * cosine[i];
    sums.cs += cosine[i] * sine[i];
    sums.cz += cosine[i] * z;
    sums.sz += sine[i] * z;
    also_count(z);
  }
  sums.ss = static_cast<double>(count) - sums.cc;
  return sums;
}

QUOIN_MULTIVERSION
void add_up_finite(const double* cosine, const double* sine, const double* inverse_range,
                   std::size_t count, InverseRangeSums& out) {
  out = add_up(cosine, sine, inverse_range, count, [](double) {});
}

/// Counts the infinite ranges, too.
QUOIN_MULTIVERSION
void add_up_any(const double* cosine, const double* sine, const double* inverse_range,
                std::size_t count, InverseRangeSums& out, double& infinite) {
  double zeros = 0.0;
  out = add_up(cosine, sine, inverse_range, count,
               [&zeros](double z) { zeros += z > 0.0 ? 0.0 : 1.0; });
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

/// What the outer products of the influences of independent points have to be summed from. The
/// influence of a bearing above is (s w - B, A - c w) with w = 2 (A c + B s) - z.
struct InfluenceSums {
  double bearing = 0.0;  ///< of w^2
  double cc = 0.0;       ///< of c^2 (z^4 - w^2), each times its variance
  double cs = 0.0;
  double ss = 0.0;
};

QUOIN_MULTIVERSION
void add_up_influences(const double* __restrict cosine, const double* __restrict sine,
                       const double* __restrict inverse_range, std::size_t count, double a,
                       double b, double range_stddev, double bearing_stddev, InfluenceSums& out) {
  InfluenceSums sums;
  const double double_a = 2.0 * bearing_stddev * a;
  const double double_b = 2.0 * bearing_stddev * b;
  for (std::size_t i = 0; i < count; ++i) {
    const double c = cosine[i];
    const double s = sine[i];
    const double z = inverse_range[i];
    const double w = double_a * c + double_b * s - bearing_stddev * z;
    const double range = range_stddev * z * z;
    const double bearing = w * w;
    const double difference = range * range - bearing;
    sums.bearing += bearing;
    sums.cc += c * (c * difference);
    sums.cs += c * (s * difference);
    sums.ss += s * (s * difference);
  }
  out = sums;
}

}  // namespace

InverseRangeSums inverse_range_sums(const PointsView& points, std::size_t begin, std::size_t end) {
  InverseRangeSums sums;
  add_up_finite(&points.cosine[begin], &points.sine[begin], &points.inverse_range[begin],
                end - begin, sums);
  return sums;
}

Symmetric2 inverse_range_influence(const PointsView& points, const InverseLine& line,
                                   const SensorModel& sensor) {
  const double a = line.q.x();
  const double b = line.q.y();
  InfluenceSums sums;
  add_up_influences(points.cosine.data(), points.sine.data(), points.inverse_range.data(),
                    points.size(), a, b, sensor.range_stddev, sensor.bearing_stddev, sums);
  // The normal equations M q = v make v the sum of (c, s) w.
  const double variance = sensor.bearing_stddev * sensor.bearing_stddev;
  const auto count = static_cast<double>(points.size());
  const double va = line.v.x() - count * a;
  const double vb = line.v.y() - count * b;
  return {sums.cc + sums.bearing - variance * (b * vb + b * line.v.y()),
          sums.cs + variance * (a * line.v.y() + b * va),
          sums.ss + sums.bearing - variance * (a * va + a * line.v.x())};
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
  add_up_any(points.cosine.data(), points.sine.data(), points.inverse_range.data(), points.size(),
             sums, infinite);
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
  Symmetric2 influence = inverse_range_influence(points, line, sensor);
  if (counted == CountedErrors::independent_and_bias) {
    add_bearing_bias(line, sensor.bearing_stddev * sensor.bearing_stddev, influence);
  }
  return to_normal_form(line, influence);
}

}  // namespace quoin
