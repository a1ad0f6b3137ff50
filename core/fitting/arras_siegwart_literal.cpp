// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/fitting/arras_siegwart_literal.hpp"

#include <cmath>

namespace quoin {

Line arras_siegwart_literal(const PointsView& points, const SensorModel& sensor) {
  const std::size_t n = points.size();
  const auto weight = [&](std::size_t i) {  // eq. (3)
    const double root = sensor.range_stddev * points.range[i] * sensor.bearing_stddev;
    return 1.0 / (root * root);
  };
  double weights = 0.0;
  double single_sine = 0.0;
  double single_cosine = 0.0;
  double double_sine = 0.0;
  double double_cosine = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    const double w = weight(i);
    weights += w;
    single_sine += w * points.range[i] * points.range[i] * std::sin(2.0 * points.bearing[i]);
    single_cosine += w * points.range[i] * points.range[i] * std::cos(2.0 * points.bearing[i]);
    for (std::size_t k = 0; k < n; ++k) {
      const double product = w * points.range[i] * weight(k) * points.range[k];
      double_sine += product * std::sin(points.bearing[i]) * std::cos(points.bearing[k]);
      double_cosine += product * std::cos(points.bearing[i] + points.bearing[k]);
    }
  }
  const double alpha = 0.5 * std::atan2(2.0 / weights * double_sine - single_sine,
                                        1.0 / weights * double_cosine - single_cosine);
  double r = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    r += weight(i) * points.range[i] * std::cos(points.bearing[i] - alpha);
  }
  return normalized(LineEstimate{{alpha, r / weights}, {}}).line;
}

}  // namespace quoin
