// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/segmentation/iepf.hpp"

namespace quoin {

Iepf::Iepf(const Parameters& parameters) : builder_(parameters) {}

void Iepf::split(const PointsView& points, const Segment& cluster) {
  // The leftmost is on top, so that pieces come out in order. Chords share the vertex, pieces do
  // not: it stays with the left.
  std::size_t next_begin = cluster.begin;
  stack_.clear();
  stack_.push_back(cluster);
  while (!stack_.empty()) {
    const Segment chord = stack_.back();
    if (chord.size() >= 3) {
      const FarthestPoint farthest =
          farthest_from_chord(points.subview(chord.begin, chord.end), builder_.tolerance());
      if (farthest.beyond() && farthest.index > 0 && farthest.index + 1 < chord.size()) {
        const std::size_t vertex = chord.begin + farthest.index;
        stack_.back() = {vertex, chord.end};
        stack_.push_back({chord.begin, vertex + 1});
        continue;
      }
    }
    stack_.pop_back();
    builder_.add({next_begin, chord.end});
    next_begin = chord.end;
  }
}

void Iepf::operator()(const PointsView& points, const SensorModel& sensor,
                      std::vector<Segment>& segments) {
  builder_.start(points, sensor);
  for (const Segment& cluster : builder_.clusters()) split(points, cluster);
  builder_.finish(points, segments);
}

}  // namespace quoin
