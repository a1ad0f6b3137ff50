// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/fitting/moments.hpp"

#include "core/sensor/multiversion.hpp"

namespace quoin {
namespace {

QUOIN_MULTIVERSION
void add_up(const double* __restrict x, const double* __restrict y,
            const double* __restrict inverse_range, std::size_t count, bool weighted,
            Moments& out) {
  // About the first point instead of the sensor: one pass, and no digits lost on far walls.
  const double x0 = x[0];
  const double y0 = y[0];
  Moments sums;
  for (std::size_t i = 0; i < count; ++i) {
    const double w = weighted ? inverse_range[i] * inverse_range[i] : 1.0;
    const double dx = x[i] - x0;
    const double dy = y[i] - y0;
    sums.weight += w;
    sums.mean_x += w * dx;
    sums.mean_y += w * dy;
    sums.spread.xx += w * dx * dx;
    sums.spread.xy += w * dx * dy;
    sums.spread.yy += w * dy * dy;
  }
  out = sums;
}

}  // namespace

Moments moments_of(const PointsView& points, PointWeights weights) {
  Moments m;
  add_up(points.x.data(), points.y.data(), points.inverse_range.data(), points.size(),
         weights == PointWeights::inverse_square_range, m);
  m.mean_x /= m.weight;
  m.mean_y /= m.weight;
  m.spread.xx -= m.weight * m.mean_x * m.mean_x;
  m.spread.xy -= m.weight * m.mean_x * m.mean_y;
  m.spread.yy -= m.weight * m.mean_y * m.mean_y;
  m.mean_x += points.x[0];
  m.mean_y += points.y[0];
  return m;
}

}  // namespace quoin
