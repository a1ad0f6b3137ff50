// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "deploy/evaluation/pictures.hpp"

#include "core/statistics/chi_square.hpp"

namespace quoin::deploy {

DrawnPoint drawn(const Eigen::Vector2d& point) { return {point.x(), point.y()}; }

DrawnCorner drawn(const CornerEstimate& corner, double mahalanobis_squared, std::size_t series) {
  const Ellipse shape = ellipse(corner.covariance, mahalanobis_squared);
  return {drawn(corner.position), shape.semi_major, shape.semi_minor, shape.direction, series};
}

Drawing picture(const Extraction& extraction) {
  Drawing drawing;
  const Points& points = extraction.points();
  for (std::size_t i = 0; i < points.size(); ++i) {
    drawing.points.push_back({points.x[i], points.y[i]});
  }
  for (const LineSegment& line : extraction.lines()) {
    drawing.lines.push_back({drawn(line.start), drawn(line.end)});
  }
  for (const Corner& corner : extraction.corners()) {
    drawing.corners.push_back(drawn(corner.estimate, chi_square_2_95));
  }
  return drawing;
}

}  // namespace quoin::deploy
