// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/segmentation/iepf.hpp"

namespace quoin {

Iepf::Iepf(const Parameters& parameters) : builder_(parameters) {}

void Iepf::split(const PointsView& points, const Segment& cluster) {
  // From left to right, so that pieces come out in order. Chords share the vertex, pieces do not:
  // it stays with the left.
  std::size_t next_begin = cluster.begin;
  const std::size_t deepest = deepest_uneven_split(cluster.size());
  Chord chord{cluster};
  waiting_.clear();
  while (true) {
    Segment& segment = chord.segment;
    if (segment.size() >= 3) {
      const FarthestPoint farthest =
          farthest_from_chord(points, builder_.coarse_points(), segment, builder_.tolerance());
      if (farthest.index > 0 && farthest.index + 1 < segment.size() && farthest.beyond()) {
        const bool in_time = chord.depth < deepest;
        if (!in_time) builder_.cut_short();
        const std::size_t vertex = segment.begin + (in_time ? farthest.index : segment.size() / 2);
        ++chord.depth;
        waiting_.push_back({{vertex, segment.end}, chord.depth});
        segment.end = vertex + 1;
        continue;
      }
    }
    builder_.add({next_begin, segment.end});
    next_begin = segment.end;
    if (waiting_.empty()) return;
    chord = waiting_.back();
    waiting_.pop_back();
  }
}

void Iepf::operator()(const PointsView& scan, const SensorModel& sensor, Segmentation& found) {
  const PointsView points = builder_.start(scan, sensor);
  for (const Segment& cluster : builder_.clusters()) split(points, cluster);
  builder_.finish(found);
}

}  // namespace quoin
