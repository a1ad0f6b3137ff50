// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/segmentation/segment_builder.hpp"

#include "core/segmentation/merging.hpp"
#include "core/segmentation/refinement.hpp"

namespace quoin {

SegmentBuilder::SegmentBuilder(const SegmentationParameters& parameters)
    : parameters_(parameters), breakpoints_(parameters.breakpoint_angle) {}

void SegmentBuilder::start(const PointsView& points, const SensorModel& sensor) {
  pieces_.clear();
  cluster_ = 0;
  tolerance_ = Tolerance(parameters_, sensor, points);
  closed_ = !breakpoints_.find(points, sensor, clusters_);
}

void SegmentBuilder::add(const Segment& piece) {
  const std::size_t before = cluster_;
  while (clusters_[cluster_].end <= piece.begin) ++cluster_;
  const bool joined =
      !pieces_.empty() && before == cluster_ &&
      piece.begin - pieces_.back().segment.end < largest_gap(parameters_.min_points);
  pieces_.push_back({piece, joined});
}

void SegmentBuilder::finish(const PointsView& points, std::vector<Segment>& segments) {
  segments.clear();
  const auto min_points = static_cast<std::size_t>(parameters_.min_points);
  if (parameters_.merge || parameters_.refine) {
    drop_small(min_points, pieces_);
    fit_pieces(points, pieces_);
  }
  if (parameters_.merge) merge_collinear(points, tolerance_, pieces_);
  if (parameters_.refine) refine_boundaries(points, min_points, tolerance_, closed_, pieces_);

  const double min_length_squared = parameters_.min_length * parameters_.min_length;
  for (const Piece& piece : pieces_) {
    const Segment& segment = piece.segment;
    if (segment.size() < min_points) continue;
    const double dx = points.x[segment.end - 1] - points.x[segment.begin];
    const double dy = points.y[segment.end - 1] - points.y[segment.begin];
    const double length_squared = dx * dx + dy * dy;
    if (length_squared >= min_length_squared && length_squared > 0.0) segments.push_back(segment);
  }
}

}  // namespace quoin
