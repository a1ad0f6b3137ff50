// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/segmentation/expectation_maximization.hpp"

#include <algorithm>

#include "core/segmentation/runs.hpp"

namespace quoin {

ExpectationMaximization::ExpectationMaximization(const Parameters& parameters)
    : parameters_(parameters),
      fewest_(static_cast<std::size_t>(std::max(parameters.min_points, 3))),
      builder_(parameters) {}

void ExpectationMaximization::add_runs(const PointsView& points, const Segment& cluster) {
  for (std::size_t i = 0; i < labels_.size();) {
    const std::size_t label = labels_[i];
    std::size_t end = i + 1;
    if (label != LineMixture::background) {
      // Passes over few points that seem to be of another line but are near this one as well.
      for (std::size_t k = end; k < labels_.size() && k <= end + largest_gap_in_run; ++k) {
        if (labels_[k] == label) {
          end = k + 1;
        } else if (excess_of(mixture_.line(label), points, cluster.begin + k,
                             builder_.tolerance()) > largest_outlier) {
          break;
        }
      }
      if (end - i >= fewest_) builder_.add({cluster.begin + i, cluster.begin + end});
    }
    i = end;
  }
}

void ExpectationMaximization::operator()(const PointsView& points, const SensorModel& sensor,
                                         std::vector<Segment>& segments) {
  builder_.start(points, sensor);
  moments_.assign(points);
  for (const Segment& cluster : builder_.clusters()) {
    if (cluster.size() < fewest_) continue;
    const std::size_t window =
        std::max(static_cast<std::size_t>(parameters_.window),
                 cluster.size() / static_cast<std::size_t>(parameters_.lines) + 1);
    mixture_.start(points, cluster, moments_, builder_.tolerance(), window);
    for (int k = 0; k < parameters_.iterations; ++k) {
      mixture_.step(points, builder_.tolerance(), static_cast<double>(fewest_) / 2.0);
    }
    mixture_.label(points, builder_.tolerance(), labels_);
    add_runs(points, cluster);
  }
  builder_.finish(points, segments);
}

}  // namespace quoin
