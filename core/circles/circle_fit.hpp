// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <string_view>
#include <tuple>
#include <utility>

#include <Eigen/Core>

#include "core/circles/circle.hpp"
#include "core/parameters/parameter.hpp"
#include "core/sensor/points.hpp"

namespace quoin {

/// Why the points of an arc give no circle.
enum class CircleFailure {
  none,
  too_few_points,  ///< fewer than three
  degenerate,      ///< the points do not determine a circle, such as on a line
  not_determined,  ///< there is one, but the noise leaves its size open: `max_nonlinearity`
  not_finite,      ///< the numbers left the range of double
  not_converged,   ///< an iteration found no end
};

template <>
struct EnumNames<CircleFailure> {
  static constexpr std::array<std::pair<CircleFailure, std::string_view>, 6> names{
      {{CircleFailure::none, "none"},
       {CircleFailure::too_few_points, "too_few_points"},
       {CircleFailure::degenerate, "degenerate"},
       {CircleFailure::not_determined, "not_determined"},
       {CircleFailure::not_finite, "not_finite"},
       {CircleFailure::not_converged, "not_converged"}}};
};

/// How often each CircleFailure occurred, indexed by its value.
using CircleFailureCounts = std::array<std::size_t, EnumNames<CircleFailure>::names.size()>;

/// A circle with the covariance of (x, y, radius), 3x3 [m^2].
struct CircleEstimate {
  Circle circle;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
};

/// Circle fitted to the points of one arc, or the reason why there is none.
struct CircleFit {
  CircleEstimate estimate;
  double chi_square = 0.0;  ///< sum of squared distances over their variances; points - 3 expected
  /// The larger of the standard deviation of the radius and that of a point along the circle, over
  /// the radius. The errors are Gaussian, with the covariance that is reported, as far as it is
  /// small against 1.
  double nonlinearity = 0.0;
  CircleFailure failure = CircleFailure::none;
  int iterations = 1;

  [[nodiscard]] bool ok() const { return failure == CircleFailure::none; }
  [[nodiscard]] static CircleFit failed(CircleFailure reason) {
    CircleFit fit;
    fit.failure = reason;
    fit.iterations = 0;
    return fit;
  }
};

/// Fits one circle to all points of the view. Pure: same points, same circle.
using CircleFitter = std::function<CircleFit(const PointsView&, const SensorModel&)>;

/// Parameters of every circle fitter.
struct CircleParameters {
  double max_nonlinearity = 0.15;

  static constexpr auto fields() {
    return std::make_tuple(field(
        &CircleParameters::max_nonlinearity, "max_nonlinearity", "", 0.01, 1.0,
        "fails as not_determined where the standard deviation of the radius, or that of a point "
        "along the circle, is a larger part of the radius: the covariance would not hold"));
  }
};

/// The part of a circle that was seen.
struct Arc {
  double start = 0.0;    ///< [rad] bearing about the centre, (-pi, pi]
  double end = 0.0;      ///< [rad] counter-clockwise from start, less than 2 pi after it
  bool concave = false;  ///< seen from inside, such as a round room
};

/// From the first to the last of the points, which are in the order of their bearings.
[[nodiscard]] Arc seen_arc(const Circle& circle, const PointsView& points);

/// Scales the covariance by the reduced chi square of so many points where that is larger than
/// noise gives once in 1000 times, as `scale_to_residuals` does for lines. Returns the factor, 1
/// when nothing was done.
double scale_to_residuals(CircleFit& fit, std::size_t points);

}  // namespace quoin
