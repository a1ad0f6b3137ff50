// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/segmentation/coarse_points.hpp"

#include "core/sensor/multiversion.hpp"

namespace quoin {
namespace {

QUOIN_MULTIVERSION
void round_to_single(const double* __restrict range, const double* __restrict x,
                     const double* __restrict y, std::size_t count, float* __restrict to_range,
                     float* __restrict to_x, float* __restrict to_y) {
  for (std::size_t i = 0; i < count; ++i) {
    to_range[i] = static_cast<float>(range[i]);
    to_x[i] = static_cast<float>(x[i]);
    to_y[i] = static_cast<float>(y[i]);
  }
}

}  // namespace

void CoarsePoints::assign(const PointsView& points) {
  range.resize(points.size());
  x.resize(points.size());
  y.resize(points.size());
  round_to_single(points.range.data(), points.x.data(), points.y.data(), points.size(),
                  range.data(), x.data(), y.data());
}

}  // namespace quoin
