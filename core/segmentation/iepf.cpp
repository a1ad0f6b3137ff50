// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/segmentation/iepf.hpp"

namespace quoin {

Iepf::Iepf(const Parameters& parameters) : builder_(parameters) {}

void Iepf::split(const PointsView& points, const Segment& cluster) {
  // From left to right, so that pieces come out in order. Chords share the vertex, pieces do not:
  // it stays with the left.
  std::size_t next_begin = cluster.begin;
  Segment chord = cluster;
  waiting_.clear();
  while (true) {
    if (chord.size() >= 3) {
      const FarthestPoint farthest =
          farthest_from_chord(points, builder_.coarse_points(), chord, builder_.tolerance());
      if (farthest.index > 0 && farthest.index + 1 < chord.size() && farthest.beyond()) {
        const std::size_t vertex = chord.begin + farthest.index;
        waiting_.push_back({vertex, chord.end});
        chord.end = vertex + 1;
        continue;
      }
    }
    builder_.add({next_begin, chord.end});
    next_begin = chord.end;
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
