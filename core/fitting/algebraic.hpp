// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstddef>
#include <optional>

#include "core/fitting/fit.hpp"
#include "core/fitting/point_sums.hpp"

namespace quoin {

/// The algebraic fit of A x + B y = 1 minimises the weighted sum of (A x + B y - 1)^2. With equal
/// weights it is UTLS, with 1 / range^2 it is WTLS and WCTLS: in the weights of WCTLS eq. (8)
/// sigma_rho and sigma_theta cancel. The latter is also the regression of the inverse range on
/// (cos, sin) of the bearing, because A x + B y = 1 reads A cos + B sin = 1 / range.
///
/// Its normal equations are M q = v with q = (A, B) = (cos alpha, sin alpha) / r [1/m] and the
/// moments about the sensor, M = (xx, xy, yy) and v = (x, y). det M is -c of WCTLS eq. (4) and
/// (12); it is 0 when all points lie on one ray or are equal.
[[nodiscard]] inline std::optional<Solution2x2> solve_algebraic(const Moments& moments) {
  return solve2x2({moments.xx, moments.xy, moments.yy}, {moments.x, moments.y});
}

[[nodiscard]] inline NormalLine normal_line(const Eigen::Vector2d& q) {
  const double offset = 1.0 / std::sqrt(q.x() * q.x() + q.y() * q.y());
  return {q.x() * offset, q.y() * offset, offset};
}

/// Moments about the sensor of points [begin, end) with the weights 1 / range^2.
[[nodiscard]] Moments inverse_range_moments(const PointsView& points, std::size_t begin,
                                            std::size_t end);

/// q of the fit with these weights; when it fails, `q` is left as it was.
[[nodiscard]] FitFailure find_algebraic_line(const PointsView& points, PointWeights weights,
                                             Eigen::Vector2d& q);

/// Why the normal equations of these points are singular.
[[nodiscard]] FitFailure reason_of_singularity(const PointsView& points);

/// What the covariance of the algebraic fit counts.
enum class CountedErrors {
  independent_and_bias,  ///< of each point by itself, and the bias by the noise of the bearings
  independent,           ///< of each point by itself
  common,                ///< one range error and one bearing error of all points
};

/// The line and its covariance, the fit of UTLS, WTLS and WCTLS.
[[nodiscard]] FitResult fit_algebraic(const PointsView& points, PointWeights weights,
                                      const SensorModel& sensor, CountedErrors counted);

/// The unweighted fit of eq. (1) to (7), minimising the sum of (A x + B y - 1)^2. It is known as
/// total least squares but is algebraic: not orthogonal, and dependent on where the sensor is.
///
/// `as_published` reads eq. (5) with a Jacobian of two columns, the sums over all points: one range
/// error and one bearing error common to the whole segment. That reading gives the paper's tables.
class Utls {
 public:
  static constexpr const char* name = "utls";
  static constexpr const char* description = "algebraic line fit with equal weights";
  static constexpr const char* source = "Siadat et al. 1997; Prieto-Fernandez et al. 2026, eq. 1-7";
  static constexpr const char* choose =
      "For the shortest time: in the worlds measured it is as accurate as wctls. Its as_published "
      "ellipses are far too large and serve to repeat the tables of papers only; it cannot express "
      "lines through the sensor.";

  using Parameters = CovarianceParameters;

  Utls() = default;
  explicit Utls(const Parameters& parameters) : parameters_(parameters) {}

  FitResult operator()(const PointsView& points, const SensorModel& sensor) const {
    return fit_algebraic(points, PointWeights::equal, sensor,
                         parameters_.covariance == CovarianceMode::as_published
                             ? CountedErrors::common
                             : CountedErrors::independent_and_bias);
  }

 private:
  Parameters parameters_;
};

/// Weighted total least squares of eq. (8) to (15): the algebraic fit of A x + B y = 1 with weights
/// 1 / (sigma_rho rho sigma_theta)^2; the standard deviations cancel in the line. Same line as
/// WCTLS.
///
/// `as_published` reads eq. (13) with a Jacobian of two columns, the sums over all points: one
/// range error and one bearing error common to the whole segment. That reading gives the paper's
/// tables.
class Wtls {
 public:
  static constexpr const char* name = "wtls";
  static constexpr const char* description = "algebraic line fit with weights 1 / range^2";
  static constexpr const char* source = "Prieto-Fernandez et al. 2026, eq. 8-15";
  static constexpr const char* choose =
      "To compare with wctls, nothing else: it gives the same line and the same propagated "
      "covariance. Its as_published ellipses are far too large and serve to repeat the paper's "
      "tables only.";

  using Parameters = CovarianceParameters;

  Wtls() = default;
  explicit Wtls(const Parameters& parameters) : parameters_(parameters) {}

  FitResult operator()(const PointsView& points, const SensorModel& sensor) const {
    return fit_algebraic(points, PointWeights::inverse_square_range, sensor,
                         parameters_.covariance == CovarianceMode::as_published
                             ? CountedErrors::common
                             : CountedErrors::independent_and_bias);
  }

 private:
  Parameters parameters_;
};

/// Weighted conformal total least squares. The line is found by the point Q = (cos alpha, -sin
/// alpha) / r of the inverted plane (eq. 16), with the weights of eq. (8); sigma_rho and
/// sigma_theta cancel in the line. The covariance is C_Q mapped by eq. (22) and (23), and on to
/// (alpha, r).
///
/// `as_published` is that: the paper takes C_Q from WCLM, where it is the sum of independent
/// contributions of the points already. `propagated` adds the bias that noise of the bearings gives
/// the line.
class Wctls {
 public:
  static constexpr const char* name = "wctls";
  static constexpr const char* description =
      "weighted conformal total least squares: the line by its point Q in the inverted plane";
  static constexpr const char* source = "Prieto-Fernandez et al. 2026, eq. 16-23";
  static constexpr const char* choose =
      "For the shortest time with a covariance that holds. Where the noise of the bearings is as "
      "large as their spacing, lines far from the foot of the perpendicular are biased; propagated "
      "counts that, and inverse_range is up to a tenth more accurate. Not within a few decimetres "
      "of the sensor.";

  using Parameters = CovarianceParameters;

  Wctls() = default;
  explicit Wctls(const Parameters& parameters) : parameters_(parameters) {}

  FitResult operator()(const PointsView& points, const SensorModel& sensor) const {
    // q = (A, B) = (x_Q, -y_Q): the signs cancel in (alpha, r).
    return fit_algebraic(points, PointWeights::inverse_square_range, sensor,
                         parameters_.covariance == CovarianceMode::as_published
                             ? CountedErrors::independent
                             : CountedErrors::independent_and_bias);
  }

 private:
  Parameters parameters_;
};

}  // namespace quoin
