// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/segmentation/line_tracking.hpp"

#include "core/segmentation/runs.hpp"

namespace quoin {
namespace {

// A line through fewer points fits their noise rather than predicts the next one: what two points
// predict has more than twice a point's deviation, what five predict about once.
constexpr std::size_t fewest_to_predict = 5;

}  // namespace

LineTracking::LineTracking(const Parameters& parameters)
    : look_ahead_(static_cast<std::size_t>(parameters.look_ahead)), builder_(parameters) {}

std::size_t LineTracking::track(const PointsView& points, std::size_t begin,
                                std::size_t end) const {
  const Tolerance& tolerance = builder_.tolerance();
  Moments moments;
  for (std::size_t i = begin; i < end; ++i) {
    if (i >= begin + fewest_to_predict) {
      const OrthogonalLine fit = orthogonal_line(moments);
      const double excess = fit.ok() ? excess_of(fit.line, points, i, tolerance) : 0.0;
      if (excess > 1.0) {
        if (look_ahead_ == 0 || excess > largest_outlier || i + look_ahead_ >= end) return i;
        for (std::size_t k = i + 1; k <= i + look_ahead_; ++k) {
          if (excess_of(fit.line, points, k, tolerance) > 1.0) return i;
        }
        continue;
      }
    }
    moments.add(points.x[i], points.y[i]);
  }
  return end;
}

void LineTracking::operator()(const PointsView& scan, const SensorModel& sensor,
                              Segmentation& found) {
  const PointsView points = builder_.start(scan, sensor);
  for (const Segment& cluster : builder_.clusters()) {
    for (std::size_t begin = cluster.begin; begin < cluster.end;) {
      const std::size_t end = track(points, begin, cluster.end);
      builder_.add({begin, end});
      begin = end;
    }
  }
  builder_.finish(found);
}

}  // namespace quoin
