// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/segmentation/hough.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "core/segmentation/runs.hpp"

namespace quoin {

Hough::Hough(const Parameters& parameters)
    : fewest_(static_cast<std::size_t>(std::max(parameters.min_points, 3))),
      offset_resolution_(parameters.offset_resolution),
      builder_(parameters),
      votes_(parameters.angle_resolution, parameters.offset_resolution) {}

Segment Hough::best_run(const PointsView& points, const NormalLine& line,
                        std::size_t& range) const {
  // A point of the cell is up to half its width farther from the middle.
  Tolerance tolerance = builder_.tolerance();
  const double base = std::sqrt(tolerance.base) + 0.5 * offset_resolution_;
  tolerance.base = base * base;
  tolerance.largest = std::max(tolerance.largest, tolerance.base);
  Segment best{0, 0};
  for (std::size_t k = 0; k < free_.size(); ++k) {
    const Segment run = longest_run(points, free_[k], line, tolerance);
    if (run.size() <= best.size()) continue;
    best = run;
    range = k;
  }
  return best;
}

void Hough::search(const PointsView& points, const Segment& cluster) {
  found_.clear();
  free_.clear();
  free_.push_back(cluster);
  votes_.start(points, cluster);
  while (!free_.empty()) {
    const HoughVotes::Peak peak = votes_.peak();
    if (peak.votes < static_cast<std::int32_t>(fewest_)) break;
    std::size_t range = 0;
    const Segment near = best_run(points, peak.line, range);
    const Segment run = refined_run(points, moments_, free_[range], near, builder_.tolerance());
    votes_.take_back(points, near);
    if (run.size() < fewest_) {
      votes_.discard(peak.cell);
      continue;
    }
    votes_.take_back(points, run);
    found_.push_back(run);
    const Segment rest{run.end, free_[range].end};
    free_[range].end = run.begin;
    free_.insert(free_.begin() + static_cast<std::ptrdiff_t>(range) + 1, rest);
    std::erase_if(free_, [this](const Segment& segment) { return segment.size() < fewest_; });
  }
}

void Hough::operator()(const PointsView& points, const SensorModel& sensor,
                       std::vector<Segment>& segments) {
  builder_.start(points, sensor);
  moments_.assign(points);
  for (const Segment& cluster : builder_.clusters()) {
    if (cluster.size() < fewest_) continue;
    search(points, cluster);
    builder_.add_all(found_);
  }
  builder_.finish(points, segments);
}

}  // namespace quoin
