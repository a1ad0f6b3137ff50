// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/segmentation/successive_edge_following.hpp"

#include <algorithm>

#include "core/fitting/algebraic.hpp"

namespace quoin {
namespace {

// Two ranges have a slope, but it is all noise.
constexpr std::size_t fewest_to_extrapolate = 5;

/// Adds the terms of point `i` with the weight 1 / range^2, or takes them away when `sign` is -1.
void add(const PointsView& points, std::size_t i, double sign, Moments& sums) {
  const double cosine = points.cosine[i];
  const double sine = points.sine[i];
  const double inverse = points.inverse_range[i];
  sums.weight += sign * inverse * inverse;
  sums.x += sign * cosine * inverse;
  sums.y += sign * sine * inverse;
  sums.xx += sign * cosine * cosine;
  sums.xy += sign * cosine * sine;
  sums.yy += sign * sine * sine;
}

/// Whether the range of point `i` is off the prediction of the line A x + B y = 1 through `count`
/// ranges.
bool is_edge(const PointsView& points, std::size_t i, const Eigen::Vector2d& q, std::size_t count,
             const Tolerance& tolerance) {
  const double inverse = q.x() * points.cosine[i] + q.y() * points.sine[i];
  if (!(inverse > 0.0)) return true;
  const double predicted = 1.0 / inverse;
  // (dr/dtheta) / r, the tangent of the incidence angle.
  const double slope = (q.x() * points.sine[i] - q.y() * points.cosine[i]) * predicted;
  // Noise of the bearing is noise of the range by the slope. A straight line extrapolated from n
  // points by one has about 4 / n of the variance of a point.
  const double noise = (tolerance.range + (tolerance.growth + tolerance.bearing * slope * slope) *
                                              predicted * predicted) *
                       (1.0 + 4.0 / static_cast<double>(count));
  const double difference = points.range[i] - predicted;
  return difference * difference > std::max(tolerance.base, noise);
}

}  // namespace

SuccessiveEdgeFollowing::SuccessiveEdgeFollowing(const Parameters& parameters)
    : slope_points_(static_cast<std::size_t>(parameters.slope_points)), builder_(parameters) {}

std::size_t SuccessiveEdgeFollowing::follow(const PointsView& points, std::size_t begin,
                                            std::size_t end) const {
  Moments sums;
  std::size_t oldest = begin;
  for (std::size_t i = begin; i < end; ++i) {
    const std::size_t count = i - oldest;
    if (count >= fewest_to_extrapolate) {
      const auto line = solve_algebraic(sums);
      if (line && is_edge(points, i, line->x, count, builder_.tolerance())) return i;
    }
    if (count == slope_points_) add(points, oldest++, -1.0, sums);
    add(points, i, 1.0, sums);
  }
  return end;
}

void SuccessiveEdgeFollowing::operator()(const PointsView& scan, const SensorModel& sensor,
                                         Segmentation& found) {
  const PointsView points = builder_.start(scan, sensor);
  moments_.assign(points);
  for (const Segment& cluster : builder_.clusters()) {
    for (std::size_t begin = cluster.begin; begin < cluster.end;) {
      const std::size_t end = follow(points, begin, cluster.end);
      for (const Segment& run :
           straight_runs_.find(points, moments_, {begin, end}, builder_.tolerance())) {
        builder_.add(run);
      }
      begin = end;
    }
  }
  builder_.finish(found);
}

}  // namespace quoin
