// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <functional>
#include <string_view>
#include <tuple>
#include <utility>

#include "core/geometry/line.hpp"
#include "core/parameters/parameter.hpp"
#include "core/sensor/points.hpp"

namespace quoin {

/// Which definition of the covariance a fitter reports.
enum class CovarianceMode {
  propagated,    ///< independent contributions of all points, and bias where it is known; what
                 ///< Monte Carlo confirms
  as_published,  ///< as the method's paper prints it, for comparison with its tables
};

template <>
struct EnumNames<CovarianceMode> {
  static constexpr std::array<std::pair<CovarianceMode, std::string_view>, 2> names{
      {{CovarianceMode::propagated, "propagated"}, {CovarianceMode::as_published, "as_published"}}};
};

/// Parameters of a fitter that has nothing else to choose.
struct CovarianceParameters {
  CovarianceMode covariance = CovarianceMode::propagated;

  static constexpr auto fields() {
    return std::make_tuple(field(&CovarianceParameters::covariance, "covariance",
                                 "propagated: sum over independent points; as_published: as the "
                                 "paper prints it"));
  }
};

/// Why a fit has no result.
enum class FitFailure {
  none,
  too_few_points,  ///< fewer than two, or than three where the residuals give the covariance
  degenerate,      ///< the points do not determine a line, such as all equal
  through_sensor,  ///< the line passes through the sensor, or too near it for the bearing noise,
                   ///< where this method is not defined
  not_finite,      ///< the numbers left the range of double
  not_converged,   ///< an iteration found no end
};

template <>
struct EnumNames<FitFailure> {
  static constexpr std::array<std::pair<FitFailure, std::string_view>, 6> names{
      {{FitFailure::none, "none"},
       {FitFailure::too_few_points, "too_few_points"},
       {FitFailure::degenerate, "degenerate"},
       {FitFailure::through_sensor, "through_sensor"},
       {FitFailure::not_finite, "not_finite"},
       {FitFailure::not_converged, "not_converged"}}};
};

/// How often each FitFailure occurred, indexed by its value.
using FailureCounts = std::array<std::size_t, EnumNames<FitFailure>::names.size()>;

/// Line fitted to the points of one segment, or the reason why there is none. The covariance is
/// that of (alpha, r) to first order.
struct FitResult {
  LineEstimate estimate;
  Eigen::Vector2d normal = Eigen::Vector2d::UnitX();  ///< unit vector, estimate.line.normal()
  FitFailure failure = FitFailure::none;
  int iterations = 1;
  bool converged = true;

  [[nodiscard]] bool ok() const { return failure == FitFailure::none; }
  [[nodiscard]] static FitResult failed(FitFailure reason) {
    return {{}, Eigen::Vector2d::UnitX(), reason, 0, false};
  }

  /// Fails as `not_finite` when a number is not. A variance that is 0 but for rounding stays
  /// positive.
  [[nodiscard]] static FitResult fitted(const Line& line, const Eigen::Matrix2d& covariance) {
    return fitted(line, line.normal(), covariance);
  }

  /// The same with the unit normal of the line, where it is known already.
  [[nodiscard]] static FitResult fitted(const Line& line, const Eigen::Vector2d& normal,
                                        const Eigen::Matrix2d& covariance) {
    if (!std::isfinite(line.alpha) || !std::isfinite(line.r) || !covariance.allFinite()) {
      return failed(FitFailure::not_finite);
    }
    FitResult result;
    result.estimate = {line, covariance, 0.0};
    result.estimate.covariance.diagonal() = covariance.diagonal().cwiseMax(0.0);
    result.normal = normal;
    return result;
  }
};

/// Fits one line to all points of the view. Pure: same points, same line.
using Fitter = std::function<FitResult(const PointsView&, const SensorModel&)>;

/// The line with the projections of the first and the last of the points it was fitted to, the
/// covariance about the middle between them.
[[nodiscard]] LineSegment line_segment(const LineEstimate& estimate, const PointsView& points);

/// The same with the unit normal of the line, which a FitResult has already.
[[nodiscard]] LineSegment line_segment(const LineEstimate& estimate, const Eigen::Vector2d& normal,
                                       const PointsView& points);

/// Sum over the points of the squared radial residual (rho - r / cos(phi)) over its variance, that
/// by the flatness of walls included; its expectation is size - 2 for a true sensor model.
[[nodiscard]] double chi_square(const Line& line, const PointsView& points,
                                const SensorModel& sensor);

/// Scales the covariance by the reduced chi square of so many points where that is larger than
/// noise gives once in 1000 times: an uneven wall, or a sensor with more noise than its model says.
/// Returns the factor, 1 when nothing was done.
double scale_to_residuals(LineEstimate& estimate, double chi_square, std::size_t points);

/// Covariance of (direction, offset) [rad^2, rad m; rad m, m^2] about the mid-point of a wall of
/// this length [m] that its own deviation from a line gives, on top of the sensor's noise: an
/// offset of flatness_stddev and, independent of it, a slope of as much over the root mean square
/// distance from the mid-point, length / sqrt(12). It does not depend on the number of points,
/// which share that deviation.
[[nodiscard]] Eigen::Matrix2d flatness_covariance(double flatness_stddev, double length);

/// Adds it to the covariance of the segment, which is about its mid-point.
void add_flatness(LineSegment& segment, double flatness_stddev);

/// The segment of a line with a covariance that its points do not refute: scaled to its residuals,
/// with the flatness of walls. `chi_square` is that of the line.
[[nodiscard]] LineSegment true_segment(const FitResult& fit, const PointsView& points,
                                       const SensorModel& sensor, double chi_square);

}  // namespace quoin
