// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/segmentation/line_regression.hpp"

#include <algorithm>

namespace quoin {
namespace {

constexpr std::size_t smallest_window = 3;

}  // namespace

LineRegression::LineRegression(const Parameters& parameters)
    : window_(static_cast<std::size_t>(parameters.window)),
      change_(parameters.change),
      builder_(parameters) {}

void LineRegression::compare_windows(const Segment& cluster) {
  for (std::size_t i = cluster.begin; i < cluster.end; ++i) {
    distance_[i] = 0.0;
    const std::size_t before = std::min(window_, i - cluster.begin);
    const std::size_t behind = std::min(window_, cluster.end - i);
    if (before < smallest_window || behind < smallest_window) continue;
    distance_[i] =
        squared_mahalanobis(moments_(i - before, i), moments_(i, i + behind), builder_.tolerance())
            .value_or(0.0);
  }
}

void LineRegression::add(const PointsView& points, const Segment& piece) {
  // The windows are too short for a blunt corner.
  for (const Segment& run : straight_runs_.find(points, moments_, piece, builder_.tolerance())) {
    builder_.add(run);
  }
}

void LineRegression::operator()(const PointsView& scan, const SensorModel& sensor,
                                Segmentation& found) {
  const PointsView points = builder_.start(scan, sensor);
  moments_.assign(points);
  distance_.resize(points.size());
  for (const Segment& cluster : builder_.clusters()) {
    compare_windows(cluster);
    std::size_t begin = cluster.begin;
    for (std::size_t i = cluster.begin + 1; i < cluster.end; ++i) {
      if (!is_peak(distance_, cluster, i, window_ / 2, change_)) continue;
      add(points, {begin, i});
      begin = i;
    }
    add(points, {begin, cluster.end});
  }
  builder_.finish(found);
}

}  // namespace quoin
