// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/evaluation/cramer_rao.hpp"

#include <Eigen/LU>

namespace quoin {

Eigen::Matrix2d cramer_rao_bound(const Line& line, const PointsView& points,
                                 const SensorModel& noise) {
  const Eigen::Vector2d normal = line.normal();
  Eigen::Matrix2d information = Eigen::Matrix2d::Zero();
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double cos_phi = points.cosine[i] * normal.x() + points.sine[i] * normal.y();
    const double sin_phi = points.sine[i] * normal.x() - points.cosine[i] * normal.y();
    const double along = points.range[i] * sin_phi;
    const double normal_noise = noise.range_stddev * cos_phi;
    const double tangential_noise = noise.bearing_stddev * along;
    const double weight = 1.0 / (normal_noise * normal_noise + tangential_noise * tangential_noise);
    const Eigen::Vector2d gradient(-along, 1.0);
    information += weight * gradient * gradient.transpose();
  }
  return information.inverse();
}

}  // namespace quoin
