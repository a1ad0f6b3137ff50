// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/corners/corner_finder.hpp"

namespace quoin {

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
  return segment;
}

}  // namespace quoin
