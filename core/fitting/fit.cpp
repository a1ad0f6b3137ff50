// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/fitting/fit.hpp"

#include <cmath>
#include <limits>

#include "core/sensor/multiversion.hpp"
#include "core/statistics/chi_square.hpp"

namespace quoin {
namespace {

QUOIN_MULTIVERSION
void add_up(const double* __restrict cosine, const double* __restrict sine,
            const double* __restrict range, std::size_t count, double normal_x, double normal_y,
            double r, double range_variance, double other_variance, double bearing_variance,
            double& out) {
  // A ray along the line never meets it; 88 degrees is as far as the expansion is of use.
  constexpr double smallest_cosine = 0.03;
  constexpr double smallest_variance = std::numeric_limits<double>::min();
  double sum = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    // Residual and variance both multiplied by cos^2 of the incidence angle.
    const double cos_phi = cosine[i] * normal_x + sine[i] * normal_y;
    const double sin_phi = sine[i] * normal_x - cosine[i] * normal_y;
    const double residual = range[i] * cos_phi - r;
    const double tangential = r * sin_phi / (cos_phi > smallest_cosine ? cos_phi : smallest_cosine);
    const double variance = range_variance * cos_phi * cos_phi + other_variance +
                            bearing_variance * tangential * tangential;
    sum += residual * residual / (variance > smallest_variance ? variance : smallest_variance);
  }
  out = sum;
}

}  // namespace

LineSegment line_segment(const LineEstimate& estimate, const PointsView& points) {
  return line_segment(estimate, estimate.line.normal(), points);
}

LineSegment line_segment(const LineEstimate& estimate, const Eigen::Vector2d& normal,
                         const PointsView& points) {
  LineSegment segment;
  segment.estimate = estimate;
  if (points.size() == 0) return segment;
  const auto projection = [&](std::size_t i) -> Eigen::Vector2d {
    const Eigen::Vector2d point(points.x[i], points.y[i]);
    return point - (normal.dot(point) - estimate.line.r) * normal;
  };
  segment.start = projection(0);
  segment.end = projection(points.size() - 1);
  segment.points = points.size();
  const Eigen::Vector2d middle = 0.5 * (segment.start + segment.end);
  segment.estimate = estimate.about(normal.x() * middle.y() - normal.y() * middle.x());
  return segment;
}

double chi_square(const Line& line, const PointsView& points, const SensorModel& sensor) {
  const Eigen::Vector2d normal = line.normal();
  // After the multiplication, what grows with the range that is expected, r / cos(phi), is the same
  // for all points, and so is the flatness.
  const double growing = sensor.range_stddev_per_metre * line.r;
  const double other = growing * growing + sensor.flatness_stddev * sensor.flatness_stddev;
  double sum = 0.0;
  add_up(points.cosine.data(), points.sine.data(), points.range.data(), points.size(), normal.x(),
         normal.y(), line.r, sensor.range_stddev * sensor.range_stddev, other,
         sensor.bearing_stddev * sensor.bearing_stddev, sum);
  return sum;
}

double scale_to_residuals(LineEstimate& estimate, double chi_square, std::size_t points) {
  const double factor = residual_scale(chi_square, static_cast<double>(points) - 2.0);
  estimate.covariance *= factor;
  return factor;
}

Eigen::Matrix2d flatness_covariance(double flatness_stddev, double length) {
  const double variance = flatness_stddev * flatness_stddev;
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();
  if (length > 0.0) covariance(0, 0) = 12.0 * variance / (length * length);
  covariance(1, 1) = variance;
  return covariance;
}

void add_flatness(LineSegment& segment, double flatness_stddev) {
  if (!(flatness_stddev > 0.0)) return;
  segment.estimate.covariance +=
      flatness_covariance(flatness_stddev, (segment.end - segment.start).norm());
}

LineSegment true_segment(const FitResult& fit, const PointsView& points, const SensorModel& sensor,
                         double chi_square) {
  LineEstimate estimate = fit.estimate;
  scale_to_residuals(estimate, chi_square, points.size());
  LineSegment segment = line_segment(estimate, fit.normal, points);
  add_flatness(segment, sensor.flatness_stddev);
  return segment;
}

}  // namespace quoin
