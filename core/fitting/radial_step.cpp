// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/fitting/radial_step.hpp"

#include <cmath>

#include "core/sensor/multiversion.hpp"

namespace quoin {
namespace {

struct NormalEquations {
  Symmetric2 information;
  double gradient_x = 0.0;
  double gradient_y = 0.0;
  double bearing_share = 0.0;  ///< sum of the shares of bearing noise in the variances
};

/// z = A c + B s and its slope with the bearing d = B c - A s give range - 1 / z the variance
/// V = range_variance + bearing_variance d^2 / z^4; the derivative of 1 / z with q is -(c, s) /
/// z^2.
QUOIN_MULTIVERSION
void add_up(const double* __restrict cosine, const double* __restrict sine,
            const double* __restrict range, std::size_t count, double a, double b, double smallest,
            double range_variance, double bearing_variance, NormalEquations& out) {
  Symmetric2 information;
  double gradient_x = 0.0;
  double gradient_y = 0.0;
  double bearing_share = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    const double c = cosine[i];
    const double s = sine[i];
    const double z = c * a + s * b;
    const double d = c * b - s * a;
    const double guarded = z > smallest ? z : smallest;
    const double square = guarded * guarded;
    const double from_bearing = bearing_variance * d * d;
    const double w = 1.0 / (range_variance * square * square + from_bearing);
    const double residual = guarded * (1.0 - z * range[i]);
    const double wc = w * c;
    const double ws = w * s;
    information.xx += wc * c;
    information.xy += wc * s;
    information.yy += ws * s;
    gradient_x += wc * residual;
    gradient_y += ws * residual;
    bearing_share += w * from_bearing;
  }
  out = {information, gradient_x, gradient_y, bearing_share};
}

}  // namespace

RadialStep radial_step(const PointsView& points, const Eigen::Vector2d& q,
                       const WeightVariances& variances) {
  // A ray along the line never meets it; 88 degrees is as far as the expansion is of use.
  constexpr double smallest_cosine = 0.03;
  const double norm = q.norm();
  NormalEquations equations;
  add_up(points.cosine.data(), points.sine.data(), points.range.data(), points.size(), q.x(), q.y(),
         smallest_cosine * norm, variances.range, variances.bearing, equations);
  RadialStep step;
  step.information = equations.information;
  const auto change =
      solve_inverse_line(equations.information, equations.gradient_x, equations.gradient_y);
  if (!change) {
    step.failure = reason_of_singularity(points);
    return step;
  }
  // Noise of the bearings over their variance along the segment attenuates the slope of the fit by
  // that ratio. In standard deviations of the fit, squared, the bias is about the ratio times the
  // sum of the shares that bearing noise has in the variances of the points.
  const double weight = equations.information.xx + equations.information.yy;
  const double determinant = equations.information.xx * equations.information.yy -
                             equations.information.xy * equations.information.xy;
  const double ratio = variances.bearing * weight * weight / determinant;
  const double squared_bias = ratio * equations.bearing_share;
  const auto count = static_cast<double>(points.size());
  if (ratio > 0.5 || (squared_bias > 1.0 && squared_bias > 0.01 * count)) {
    step.failure = FitFailure::through_sensor;
    return step;
  }
  // Applied as changes of r and alpha. The ranges are linear in r, whereas q overshoots when the
  // line is much too near.
  const Eigen::Vector2d normal = q / norm;
  const double outward = change->q.dot(normal) / norm;  // -dr / r
  const double angle = (normal.x() * change->q.y() - normal.y() * change->q.x()) / norm;
  if (!(outward < 1.0)) {
    step.failure = std::isfinite(outward) ? FitFailure::through_sensor : FitFailure::not_finite;
    return step;
  }
  const double new_norm = norm / (1.0 - outward);
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  step.line.q = {new_norm * (c * normal.x() - s * normal.y()),
                 new_norm * (s * normal.x() + c * normal.y())};
  step.line.inverse = change->inverse;
  return step;
}

}  // namespace quoin
