// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/segmentation/moment_sums.hpp"

#include <cmath>

namespace quoin {
namespace {

double squared_residuals(const MomentSums& moments) {
  const auto fit = orthogonal_fit(moments);
  return fit ? moments.weight * fit->across : 0.0;
}

}  // namespace

MomentSums& MomentSums::operator+=(const MomentSums& other) {
  weight += other.weight;
  x += other.x;
  y += other.y;
  xx += other.xx;
  xy += other.xy;
  yy += other.yy;
  return *this;
}

MomentSums& MomentSums::operator-=(const MomentSums& other) {
  weight -= other.weight;
  x -= other.x;
  y -= other.y;
  xx -= other.xx;
  xy -= other.xy;
  yy -= other.yy;
  return *this;
}

std::optional<OrthogonalFit> orthogonal_fit(const MomentSums& moments) {
  if (!(moments.weight > 0.0)) return std::nullopt;
  const double scale = 1.0 / moments.weight;
  OrthogonalFit fit;
  fit.x = moments.x * scale;
  fit.y = moments.y * scale;
  const double xx = moments.xx * scale - fit.x * fit.x;
  const double xy = moments.xy * scale - fit.x * fit.y;
  const double yy = moments.yy * scale - fit.y * fit.y;
  const double difference = xx - yy;
  const double spread = std::sqrt(difference * difference + 4.0 * xy * xy);
  // What rounding leaves of points at this distance from the sensor is no direction.
  if (!(spread > 1e-12 * (fit.x * fit.x + fit.y * fit.y))) return std::nullopt;
  fit.along = 0.5 * (xx + yy + spread);
  fit.across = xx + yy > spread ? 0.5 * (xx + yy - spread) : 0.0;

  // The direction has half the angle of (difference, 2 xy); the larger component comes first.
  const double cosine_twice = difference / spread;
  const double sine_twice = 2.0 * xy / spread;
  double cosine = std::sqrt(0.5 * (1.0 + cosine_twice));
  double sine = std::sqrt(0.5 * (1.0 - cosine_twice));
  if (cosine_twice >= 0.0) {
    sine = 0.5 * sine_twice / cosine;
  } else {
    cosine = 0.5 * sine_twice / sine;
  }
  fit.line = {-sine, cosine, fit.y * cosine - fit.x * sine};
  return fit;
}

std::optional<JointFit> joint_fit(const MomentSums& first, const MomentSums& second,
                                  const Tolerance& tolerance) {
  MomentSums both = first;
  both += second;
  const auto fit = orthogonal_fit(both);
  if (!fit) return std::nullopt;
  const double rise =
      both.weight * fit->across - squared_residuals(first) - squared_residuals(second);
  const double range = std::sqrt(fit->x * fit->x + fit->y * fit->y);
  if (!(range > 0.0)) return std::nullopt;
  const double cosine = fit->line.offset / range;
  const double sine = (fit->y * fit->line.normal_x - fit->x * fit->line.normal_y) / range;
  return JointFit{*fit, rise * deviations_in_tolerance * deviations_in_tolerance /
                            tolerance.squared(cosine, range * sine)};
}

void PrefixMoments::assign(const PointsView& points) {
  sums_.resize(points.size() + 1);
  MomentSums sum;
  sums_[0] = sum;
  for (std::size_t i = 0; i < points.size(); ++i) {
    sum.add(points.x[i], points.y[i]);
    sums_[i + 1] = sum;
  }
}

MomentSums PrefixMoments::operator()(std::size_t begin, std::size_t end) const {
  MomentSums moments = sums_[end];
  moments -= sums_[begin];
  return moments;
}

}  // namespace quoin
