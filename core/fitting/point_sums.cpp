// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/fitting/point_sums.hpp"

#include "core/sensor/multiversion.hpp"

namespace quoin {
namespace {

QUOIN_MULTIVERSION
void add_up(const double* __restrict x, const double* __restrict y,
            const double* __restrict inverse_range, std::size_t count, bool weighted,
            Moments& out) {
  const double x0 = x[0];
  const double y0 = y[0];
  Moments sums;
  for (std::size_t i = 0; i < count; ++i) {
    const double w = weighted ? inverse_range[i] * inverse_range[i] : 1.0;
    sums.add(x[i] - x0, y[i] - y0, w);
  }
  out = sums;
}

}  // namespace

CentralMoments central_moments(const PointsView& points, PointWeights weights) {
  Moments moments;
  add_up(points.x.data(), points.y.data(), points.inverse_range.data(), points.size(),
         weights == PointWeights::inverse_square_range, moments);
  return CentralMoments(moments, points.x[0], points.y[0]);
}

}  // namespace quoin
