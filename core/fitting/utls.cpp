// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/fitting/utls.hpp"

#include "core/fitting/inverse_line.hpp"
#include "core/fitting/point_influence.hpp"
#include "core/sensor/multiversion.hpp"

namespace quoin {
namespace {

struct OriginMoments {
  double x = 0.0;
  double y = 0.0;
  double xx = 0.0;
  double xy = 0.0;
  double yy = 0.0;
};

QUOIN_MULTIVERSION
void add_up(const double* __restrict x, const double* __restrict y, std::size_t count,
            OriginMoments& out) {
  OriginMoments sums;
  for (std::size_t i = 0; i < count; ++i) {
    sums.x += x[i];
    sums.y += y[i];
    sums.xx += x[i] * x[i];
    sums.xy += x[i] * y[i];
    sums.yy += y[i] * y[i];
  }
  out = sums;
}

/// Influences of one point on M q, exact derivatives with e = 1 - A x - B y and g = B x - A y:
///   range:  (c, s) (2 e - 1)        bearing:  (-y, x) e - (x, y) g
/// WCTLS eq. (7) in terms of the normalised line; x = rho c, so no division is needed.
inline PointInfluence influence_of(double c, double s, double x, double y, double a, double b) {
  const double e = 1.0 - a * x - b * y;
  const double g = b * x - a * y;
  return {c * (2.0 * e - 1.0), s * (2.0 * e - 1.0), -y * e - x * g, x * e - y * g};
}

QUOIN_MULTIVERSION
void add_up_influences(const double* __restrict cosine, const double* __restrict sine,
                       const double* __restrict x, const double* __restrict y, std::size_t count,
                       double a, double b, double range_variance, double bearing_variance,
                       Symmetric2& out) {
  Symmetric2 sums;
  for (std::size_t i = 0; i < count; ++i) {
    add_noise(sums, influence_of(cosine[i], sine[i], x[i], y[i], a, b), range_variance,
              bearing_variance);
  }
  out = sums;
}

/// The outer products of the summed influences: errors common to all points.
Symmetric2 common_influence(const PointsView& points, double a, double b, double range_variance,
                            double bearing_variance) {
  PointInfluence sum;
  for (std::size_t i = 0; i < points.size(); ++i) {
    sum += influence_of(points.cosine[i], points.sine[i], points.x[i], points.y[i], a, b);
  }
  Symmetric2 covariance;
  add_noise(covariance, sum, range_variance, bearing_variance);
  return covariance;
}

}  // namespace

FitResult Utls::operator()(const PointsView& points, const SensorModel& sensor) const {
  if (points.size() < 2) return FitResult::failed(FitFailure::too_few_points);
  OriginMoments sums;
  add_up(points.x.data(), points.y.data(), points.size(), sums);
  const auto line = solve_inverse_line({sums.xx, sums.xy, sums.yy}, sums.x, sums.y);
  if (!line) return FitResult::failed(reason_of_singularity(points));

  const double range_variance = sensor.range_stddev * sensor.range_stddev;
  const double bearing_variance = sensor.bearing_stddev * sensor.bearing_stddev;
  const double a = line->q.x();
  const double b = line->q.y();
  Symmetric2 influence;
  if (parameters_.covariance == CovarianceMode::as_published) {
    influence = common_influence(points, a, b, range_variance, bearing_variance);
  } else {
    add_up_influences(points.cosine.data(), points.sine.data(), points.x.data(), points.y.data(),
                      points.size(), a, b, range_variance, bearing_variance, influence);
    add_bearing_bias(*line, bearing_variance, influence);
  }
  return to_normal_form(*line, influence);
}

}  // namespace quoin
