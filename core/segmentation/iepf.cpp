// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/segmentation/iepf.hpp"

#include "core/segmentation/chord.hpp"

namespace quoin {

Iepf::Iepf(const Parameters& parameters)
    : parameters_(parameters), breakpoints_(parameters.breakpoint_angle) {}

void Iepf::split(const PointsView& points, std::size_t begin, std::size_t end) {
  // The stack holds chords by their end points, first and last included; the leftmost is on top, so
  // that pieces come out in order. Chords share the vertex, pieces do not: it stays with the left.
  bool joined = false;
  std::size_t next_begin = begin;
  stack_.clear();
  stack_.emplace_back(begin, end - 1);
  while (!stack_.empty()) {
    const auto [first, last] = stack_.back();
    if (last - first >= 2) {
      const std::size_t count = last - first + 1;
      const FarthestPoint farthest =
          farthest_from_chord(points.x.subspan(first, count), points.y.subspan(first, count),
                              parameters_.split_distance);
      if (farthest.distance > parameters_.split_distance && farthest.index > 0 &&
          farthest.index + 1 < count) {
        const std::size_t vertex = first + farthest.index;
        stack_.back() = {vertex, last};
        stack_.emplace_back(first, vertex);
        continue;
      }
    }
    stack_.pop_back();
    pieces_.push_back({{next_begin, last + 1}, joined});
    next_begin = last + 1;
    joined = true;
  }
}

void Iepf::operator()(const PointsView& points, const SensorModel& sensor,
                      std::vector<Segment>& segments) {
  segments.clear();
  pieces_.clear();
  const bool broken_at_seam = breakpoints_.find(points, sensor, starts_);
  for (std::size_t i = 0; i + 1 < starts_.size(); ++i) {
    split(points, starts_[i], starts_[i + 1]);
  }
  const auto min_points = static_cast<std::size_t>(parameters_.min_points);
  if (parameters_.refine) {
    refine(points, min_points, parameters_.split_distance, !broken_at_seam, pieces_);
  }
  for (const Piece& piece : pieces_) {
    const Segment& segment = piece.segment;
    if (segment.size() < min_points) continue;
    const double dx = points.x[segment.end - 1] - points.x[segment.begin];
    const double dy = points.y[segment.end - 1] - points.y[segment.begin];
    const double length_squared = dx * dx + dy * dy;
    if (!(length_squared >= parameters_.min_length * parameters_.min_length)) continue;
    if (length_squared > 0.0) segments.push_back(segment);
  }
}

}  // namespace quoin
