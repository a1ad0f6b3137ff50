// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/segmentation/segment_builder.hpp"

#include <algorithm>

#include "core/segmentation/merging.hpp"
#include "core/segmentation/refinement.hpp"
#include "core/segmentation/selection.hpp"

namespace quoin {

SegmentBuilder::SegmentBuilder(const SegmentationParameters& parameters)
    : parameters_(parameters), breakpoints_(parameters.breakpoint_angle) {}

void SegmentBuilder::start(const PointsView& points, const SensorModel& sensor) {
  pieces_.clear();
  cluster_ = 0;
  sensor_ = sensor;
  tolerance_ = Tolerance(parameters_, sensor, points);
  coarse_points_.assign(points);
  closed_ = !breakpoints_.find(coarse_points_, sensor, clusters_);
}

void SegmentBuilder::add(const Segment& piece) {
  const std::size_t before = cluster_;
  while (clusters_[cluster_].end <= piece.begin) ++cluster_;
  const bool joined =
      !pieces_.empty() && before == cluster_ &&
      piece.begin - pieces_.back().segment.end < largest_gap(parameters_.min_points);
  pieces_.push_back({piece, joined});
}

void SegmentBuilder::add_all(std::vector<Segment>& pieces) {
  std::sort(pieces.begin(), pieces.end(),
            [](const Segment& a, const Segment& b) { return a.begin < b.begin; });
  for (const Segment& piece : pieces) add(piece);
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

  select_lines(points, pieces_, parameters_, sensor_, tolerance_, segments);
}

}  // namespace quoin
