// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/segmentation/ransac.hpp"

#include <algorithm>
#include <cmath>

namespace quoin {
namespace {

/// The line through two points; through the sensor when they are equal.
NormalLine line_through(const PointsView& points, std::size_t first, std::size_t second) {
  const double dx = points.x[second] - points.x[first];
  const double dy = points.y[second] - points.y[first];
  const double length = std::sqrt(dx * dx + dy * dy);
  if (!(length > 0.0)) return {-points.sine[first], points.cosine[first], 0.0};
  NormalLine line{-dy / length, dx / length, 0.0};
  line.offset = line.normal_x * points.x[first] + line.normal_y * points.y[first];
  return line;
}

}  // namespace

Ransac::Ransac(const Parameters& parameters) : parameters_(parameters), builder_(parameters) {}

Segment Ransac::search(const PointsView& points, const Segment& range, Random& random) const {
  const Tolerance& tolerance = builder_.tolerance();
  const std::size_t spread =
      std::min(range.size() - 1, static_cast<std::size_t>(parameters_.sample_spread));
  Segment best{range.begin, range.begin};
  for (int trial = 0; trial < parameters_.trials && best.size() < range.size(); ++trial) {
    const std::size_t distance = 1 + random.index(spread);
    const std::size_t first = range.begin + random.index(range.size() - distance);
    const NormalLine line = line_through(points, first, first + distance);
    const Segment run = run_around(points, range, first, line, tolerance);
    if (run.size() > best.size()) best = run;
  }
  return refined_run(points, moments_, range, best, tolerance);
}

void Ransac::operator()(const PointsView& scan, const SensorModel& sensor, Segmentation& found) {
  const PointsView points = builder_.start(scan, sensor);
  moments_.assign(points);
  Random random(static_cast<std::uint64_t>(parameters_.seed));
  const auto fewest = static_cast<std::size_t>(std::max(parameters_.min_points, 2));
  for (const Segment& cluster : builder_.clusters()) {
    // The leftmost range is on top. Runs come out of order: what is behind one waits below it.
    found_.clear();
    stack_.clear();
    stack_.push_back(cluster);
    while (!stack_.empty()) {
      const Segment range = stack_.back();
      stack_.pop_back();
      if (range.size() < fewest) continue;
      const Segment run = search(points, range, random);
      if (run.size() < fewest) continue;
      found_.push_back(run);
      stack_.push_back({run.end, range.end});
      stack_.push_back({range.begin, run.begin});
    }
    builder_.add_all(found_);
  }
  builder_.finish(found);
}

}  // namespace quoin
