// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/fitting/algebraic.hpp"

#include <algorithm>
#include <limits>

#include "core/sensor/multiversion.hpp"

namespace quoin {
namespace {

// The moments about the sensor. With the weights 1 / range^2 they are sums of products of the
// cosine c, the sine s and the inverse range z.

QUOIN_MULTIVERSION
void add_up_equal(const double* __restrict x, const double* __restrict y, std::size_t count,
                  Moments& out) {
  Moments sums;
  for (std::size_t i = 0; i < count; ++i) sums.add(x[i], y[i]);
  out = sums;
}

template <class Count>
[[gnu::always_inline]] inline Moments add_up_inverse(const double* __restrict cosine,
                                                     const double* __restrict sine,
                                                     const double* __restrict inverse_range,
                                                     std::size_t count, const Count& also_count) {
  Moments sums;
  for (std::size_t i = 0; i < count; ++i) {
    const double z = inverse_range[i];
    sums.weight += z * z;
    sums.x += cosine[i] * z;
    sums.y += sine[i] * z;
    sums.xx += cosine[i] * cosine[i];
    sums.xy += cosine[i] * sine[i];
    also_count(z);
  }
  sums.yy = static_cast<double>(count) - sums.xx;
  return sums;
}

QUOIN_MULTIVERSION
void add_up_finite(const double* cosine, const double* sine, const double* inverse_range,
                   std::size_t count, Moments& out) {
  out = add_up_inverse(cosine, sine, inverse_range, count, [](double) {});
}

/// Counts the infinite ranges, too.
QUOIN_MULTIVERSION
void add_up_any(const double* cosine, const double* sine, const double* inverse_range,
                std::size_t count, Moments& out, double& infinite) {
  double zeros = 0.0;
  out = add_up_inverse(cosine, sine, inverse_range, count,
                       [&zeros](double z) { zeros += z > 0.0 ? 0.0 : 1.0; });
  infinite = zeros;
}

struct AlgebraicLine {
  Moments moments;
  Solution2x2 solution;  ///< q and M^-1

  [[nodiscard]] double a() const { return solution.x.x(); }
  [[nodiscard]] double b() const { return solution.x.y(); }
};

FitFailure solve(const PointsView& points, PointWeights weights, AlgebraicLine& line) {
  if (points.size() < 2) return FitFailure::too_few_points;
  if (weights == PointWeights::equal) {
    add_up_equal(points.x.data(), points.y.data(), points.size(), line.moments);
  } else {
    double infinite = 0.0;
    add_up_any(points.cosine.data(), points.sine.data(), points.inverse_range.data(), points.size(),
               line.moments, infinite);
    // The inverse of an infinite range is 0 and would pass for a measurement.
    if (infinite > 0.0) return FitFailure::not_finite;
  }
  const auto solution = solve_algebraic(line.moments);
  if (!solution) return reason_of_singularity(points);
  line.solution = *solution;
  return FitFailure::none;
}

// The covariance of q is M^-1 S M^-1 with S the sum over the points of J diag(sigma_rho^2,
// sigma_theta^2) J', where J is the exact derivative of M q with the range and bearing of a point.

/// Equal weights, WCTLS eq. (7) in terms of the normalised line, with e = 1 - A x - B y and g = B x
/// - A y:
///   range:  (c, s) (2 e - 1)        bearing:  (-y, x) e - (x, y) g
/// x = rho c, so no division is needed.
inline PointJacobian equal_jacobian(double c, double s, double x, double y, double a, double b) {
  const double e = 1.0 - a * x - b * y;
  const double g = b * x - a * y;
  return {c * (2.0 * e - 1.0), s * (2.0 * e - 1.0), -y * e - x * g, x * e - y * g};
}

/// Weights 1 / range^2, WCTLS eq. (14) and (15) with the weights differentiated, times M / c_w,
/// with e the residual of the regression and d the slope of the fitted inverse range z with
/// bearing:
///   range:   -(c, s) z^2            bearing:  (-s, c) e - (c, s) d
inline PointJacobian inverse_jacobian(double c, double s, double z, double a, double b) {
  const double e = z - (c * a + s * b);
  const double d = c * b - s * a;
  return {-c * z * z, -s * z * z, -s * e - c * d, c * e - s * d};
}

QUOIN_MULTIVERSION
void add_up_equal_noise(const double* __restrict cosine, const double* __restrict sine,
                        const double* __restrict x, const double* __restrict y, std::size_t count,
                        double a, double b, double range_variance, double range_growth,
                        double bearing_variance, Symmetric2& out) {
  Symmetric2 sums;
  for (std::size_t i = 0; i < count; ++i) {
    add_noise(sums, equal_jacobian(cosine[i], sine[i], x[i], y[i], a, b),
              range_variance + range_growth * (x[i] * x[i] + y[i] * y[i]), bearing_variance);
  }
  out = sums;
}

/// S with the weights 1 / range^2 is a sum of these. The bearing's derivative above is (s w - B,
/// A - c w) with w = 2 (A c + B s) - z.
struct InverseNoise {
  double bearing = 0.0;  ///< of w^2
  double cc = 0.0;       ///< of c^2 (z^4 - w^2), each times its variance
  double cs = 0.0;
  double ss = 0.0;
};

QUOIN_MULTIVERSION
void add_up_inverse_noise(const double* __restrict cosine, const double* __restrict sine,
                          const double* __restrict inverse_range, std::size_t count, double a,
                          double b, double range_variance, double range_growth,
                          double bearing_stddev, InverseNoise& out) {
  InverseNoise sums;
  const double double_a = 2.0 * bearing_stddev * a;
  const double double_b = 2.0 * bearing_stddev * b;
  for (std::size_t i = 0; i < count; ++i) {
    const double c = cosine[i];
    const double s = sine[i];
    const double z = inverse_range[i];
    const double w = double_a * c + double_b * s - bearing_stddev * z;
    const double square = z * z;
    const double range = square * (range_variance * square + range_growth);
    const double bearing = w * w;
    const double difference = range - bearing;
    sums.bearing += bearing;
    sums.cc += c * (c * difference);
    sums.cs += c * (s * difference);
    sums.ss += s * (s * difference);
  }
  out = sums;
}

Symmetric2 independent_noise(const PointsView& points, PointWeights weights,
                             const AlgebraicLine& line, const SensorModel& sensor) {
  const double a = line.a();
  const double b = line.b();
  const double variance = sensor.bearing_stddev * sensor.bearing_stddev;
  const double range = sensor.range_stddev * sensor.range_stddev;
  const double growth = sensor.range_stddev_per_metre * sensor.range_stddev_per_metre;
  if (weights == PointWeights::equal) {
    Symmetric2 sums;
    add_up_equal_noise(points.cosine.data(), points.sine.data(), points.x.data(), points.y.data(),
                       points.size(), a, b, range, growth, variance, sums);
    return sums;
  }
  InverseNoise sums;
  add_up_inverse_noise(points.cosine.data(), points.sine.data(), points.inverse_range.data(),
                       points.size(), a, b, range, growth, sensor.bearing_stddev, sums);
  // The normal equations M q = v make v the sum of (c, s) w.
  const auto count = static_cast<double>(points.size());
  const Moments& m = line.moments;
  const double va = m.x - count * a;
  const double vb = m.y - count * b;
  return {sums.cc + sums.bearing - variance * (b * vb + b * m.y),
          sums.cs + variance * (a * m.y + b * va),
          sums.ss + sums.bearing - variance * (a * va + a * m.x)};
}

/// If one range error, in standard deviations of each range, and one bearing error were common to
/// all points: the Jacobians are summed first. This is WCTLS eq. (5) and (13) with a Jacobian of
/// two columns.
Symmetric2 common_noise(const PointsView& points, PointWeights weights, const AlgebraicLine& line,
                        const SensorModel& sensor) {
  PointJacobian sum;
  for (std::size_t i = 0; i < points.size(); ++i) {
    PointJacobian jacobian = weights == PointWeights::equal
                                 ? equal_jacobian(points.cosine[i], points.sine[i], points.x[i],
                                                  points.y[i], line.a(), line.b())
                                 : inverse_jacobian(points.cosine[i], points.sine[i],
                                                    points.inverse_range[i], line.a(), line.b());
    const double range_stddev = std::sqrt(sensor.range_variance(points.range[i]));
    jacobian.range_x *= range_stddev;
    jacobian.range_y *= range_stddev;
    sum += jacobian;
  }
  Symmetric2 noise;
  add_noise(noise, sum, 1.0, sensor.bearing_stddev * sensor.bearing_stddev);
  return noise;
}

/// Adds the square of the bias that noise of the bearings gives the line, which makes S that of the
/// expected squared error. The noise turns the regressors p, M = sum p p', v = sum p z: to second
/// order M grows by sigma_theta^2 (tr(M) I - 2 M) and v by -sigma_theta^2 v / 2, so that M q is off
/// by sigma_theta^2 (3 v / 2 - tr(M) q).
void add_bearing_bias(const AlgebraicLine& line, double bearing_variance, Symmetric2& noise) {
  const Moments& m = line.moments;
  const Eigen::Vector2d bias =
      bearing_variance * (1.5 * Eigen::Vector2d(m.x, m.y) - (m.xx + m.yy) * line.solution.x);
  noise.xx += bias.x() * bias.x();
  noise.xy += bias.x() * bias.y();
  noise.yy += bias.y() * bias.y();
}

/// The line in normal form and the covariance of (alpha, r) from M^-1 S M^-1, the covariance of q.
FitResult to_normal_form(const AlgebraicLine& line, const Symmetric2& noise) {
  const double a = line.a();
  const double b = line.b();
  const double r_squared = 1.0 / (a * a + b * b);
  const double r = std::sqrt(r_squared);

  // Rows of d(alpha, r)/d(A, B) M^-1. With the sign of y turned this is the chain of WCTLS eq. (23)
  // from Q to the unit normal and the distance, and on to alpha.
  const Symmetric2& w = line.solution.inverse;
  const double alpha_a = -b * r_squared;
  const double alpha_b = a * r_squared;
  const double r_a = -alpha_b * r;
  const double r_b = alpha_a * r;
  const double alpha_x = alpha_a * w.xx + alpha_b * w.xy;
  const double alpha_y = alpha_a * w.xy + alpha_b * w.yy;
  const double r_x = r_a * w.xx + r_b * w.xy;
  const double r_y = r_a * w.xy + r_b * w.yy;
  const auto product = [&noise](double ux, double uy, double vx, double vy) {
    return noise.xx * ux * vx + noise.xy * (ux * vy + uy * vx) + noise.yy * uy * vy;
  };
  Eigen::Matrix2d covariance;
  covariance(0, 0) = product(alpha_x, alpha_y, alpha_x, alpha_y);
  covariance(0, 1) = product(alpha_x, alpha_y, r_x, r_y);
  covariance(1, 0) = covariance(0, 1);
  covariance(1, 1) = product(r_x, r_y, r_x, r_y);
  return FitResult::fitted({direction_of(a, b), r}, {a * r, b * r}, covariance);
}

}  // namespace

Moments inverse_range_moments(const PointsView& points, std::size_t begin, std::size_t end) {
  Moments sums;
  add_up_finite(&points.cosine[begin], &points.sine[begin], &points.inverse_range[begin],
                end - begin, sums);
  return sums;
}

FitFailure find_algebraic_line(const PointsView& points, PointWeights weights, Eigen::Vector2d& q) {
  AlgebraicLine line;
  const FitFailure failure = solve(points, weights, line);
  if (failure == FitFailure::none) q = line.solution.x;
  return failure;
}

FitFailure reason_of_singularity(const PointsView& points) {
  double extent = 0.0;
  double size = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double square = points.x[i] * points.x[i] + points.y[i] * points.y[i];
    if (!std::isfinite(square) || square < std::numeric_limits<double>::min()) {
      return FitFailure::not_finite;
    }
    extent = std::max(
        {extent, std::abs(points.x[i] - points.x[0]), std::abs(points.y[i] - points.y[0])});
    size = std::max({size, std::abs(points.x[i]), std::abs(points.y[i])});
  }
  return extent > 1e-9 * size ? FitFailure::through_sensor : FitFailure::degenerate;
}

FitResult fit_algebraic(const PointsView& points, PointWeights weights, const SensorModel& sensor,
                        CountedErrors counted) {
  AlgebraicLine line;
  const FitFailure failure = solve(points, weights, line);
  if (failure != FitFailure::none) return FitResult::failed(failure);
  if (counted == CountedErrors::common) {
    return to_normal_form(line, common_noise(points, weights, line, sensor));
  }
  Symmetric2 noise = independent_noise(points, weights, line, sensor);
  if (counted == CountedErrors::independent_and_bias) {
    add_bearing_bias(line, sensor.bearing_stddev * sensor.bearing_stddev, noise);
  }
  return to_normal_form(line, noise);
}

}  // namespace quoin
