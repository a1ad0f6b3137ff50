// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/segmentation/hierarchical.hpp"

#include <algorithm>
#include <cmath>

namespace quoin {
namespace {

constexpr std::size_t fewest_in_cluster = 5;
constexpr std::size_t fewest_for_slope = 3;
// Squared, in squared tolerances; a tolerance being 4 standard deviations or more, what is left
// is 2.8 or more.
constexpr double explained_by_noise = 0.5;

/// The regression of the coordinates on the bearing.
struct Slopes {
  double x = 0.0;         ///< [m/rad]
  double y = 0.0;         ///< [m/rad]
  double variance = 0.0;  ///< [1/rad^2] of a slope for coordinates with a variance of one
};

/// Of points [begin, end). The sine of the bearing from the first point stands for the bearing,
/// which jumps where it is wrapped.
Slopes slopes_of(const PointsView& points, std::size_t begin, std::size_t end) {
  double t = 0.0, x = 0.0, y = 0.0, tt = 0.0, tx = 0.0, ty = 0.0;
  for (std::size_t i = begin; i < end; ++i) {
    const double bearing = sine_between(points, begin, i);
    const double dx = points.x[i] - points.x[begin];
    const double dy = points.y[i] - points.y[begin];
    t += bearing;
    x += dx;
    y += dy;
    tt += bearing * bearing;
    tx += bearing * dx;
    ty += bearing * dy;
  }
  const double scale = 1.0 / static_cast<double>(end - begin);
  tt -= t * t * scale;
  if (!(tt > 1e-12)) return {};
  return {(tx - t * x * scale) / tt, (ty - t * y * scale) / tt, 1.0 / tt};
}

/// Mean and one standard deviation.
double peak_limit(const std::vector<double>& values, const Segment& cluster) {
  double sum = 0.0;
  double squares = 0.0;
  for (std::size_t i = cluster.begin; i < cluster.end; ++i) {
    sum += values[i];
    squares += values[i] * values[i];
  }
  const double scale = 1.0 / static_cast<double>(cluster.size());
  const double mean = sum * scale;
  return mean + std::sqrt(std::max(0.0, squares * scale - mean * mean));
}

}  // namespace

Hierarchical::Hierarchical(const Parameters& parameters)
    : parameters_(parameters), builder_(parameters) {}

void Hierarchical::compute_changes(const PointsView& points, const Segment& cluster) {
  const auto width = static_cast<std::size_t>(parameters_.slope_points);
  for (std::size_t i = cluster.begin; i < cluster.end; ++i) {
    change_x_[i] = 0.0;
    change_y_[i] = 0.0;
    // The point itself is on both sides.
    const std::size_t begin = i - std::min(width, i - cluster.begin);
    const std::size_t end = std::min(i + width + 1, cluster.end);
    const std::size_t fewest = std::min(fewest_for_slope, width + 1);
    if (i + 1 - begin < fewest || end - i < fewest) continue;
    const Slopes before = slopes_of(points, begin, i + 1);
    const Slopes behind = slopes_of(points, i, end);
    const double variance = explained_by_noise * (before.variance + behind.variance);
    const double x = behind.x - before.x;
    const double y = behind.y - before.y;
    const Tolerance& tolerance = builder_.tolerance();
    if (x * x > variance * tolerance.squared(points, i, 1.0, 0.0)) change_x_[i] = std::abs(x);
    if (y * y > variance * tolerance.squared(points, i, 0.0, 1.0)) change_y_[i] = std::abs(y);
  }
}

void Hierarchical::add(const PointsView& points, const Segment& piece) {
  if (piece.size() < fewest_in_cluster) return;
  const OrthogonalLine fit = orthogonal_line(moments_(piece.begin, piece.end));
  if (!fit.ok() || !(fit.along > parameters_.eigenvalue_ratio * fit.across)) return;
  // A long wall with a niche is elongated too.
  const Segment straight = straight_run(points, moments_, piece, builder_.tolerance());
  if (straight.size() >= fewest_in_cluster) builder_.add(straight);
}

void Hierarchical::split_at_slopes(const PointsView& points, const Segment& cluster) {
  if (cluster.size() < fewest_in_cluster) return;
  compute_changes(points, cluster);
  const auto width = static_cast<std::size_t>(parameters_.slope_points);
  const double limit_x = peak_limit(change_x_, cluster);
  const double limit_y = peak_limit(change_y_, cluster);
  std::size_t begin = cluster.begin;
  for (std::size_t i = cluster.begin + 1; i < cluster.end; ++i) {
    if (!is_peak(change_x_, cluster, i, width, limit_x) &&
        !is_peak(change_y_, cluster, i, width, limit_y)) {
      continue;
    }
    add(points, {begin, i});
    begin = i;
  }
  add(points, {begin, cluster.end});
}

void Hierarchical::split_at_gaps(const PointsView& points, const Segment& cluster) {
  std::size_t begin = cluster.begin;
  for (std::size_t i = cluster.begin + 1; i < cluster.end; ++i) {
    const double spacing =
        std::min(points.range[i - 1], points.range[i]) * std::abs(sine_between(points, i - 1, i));
    const double limit = std::max(parameters_.cluster_distance, 2.0 * spacing);
    if (squared_distance(points, i - 1, i) <= limit * limit) continue;
    split_at_slopes(points, {begin, i});
    begin = i;
  }
  split_at_slopes(points, {begin, cluster.end});
}

void Hierarchical::operator()(const PointsView& scan, const SensorModel& sensor,
                              Segmentation& found) {
  const PointsView points = builder_.start(scan, sensor);
  moments_.assign(points);
  change_x_.resize(points.size());
  change_y_.resize(points.size());
  for (const Segment& cluster : builder_.clusters()) split_at_gaps(points, cluster);
  builder_.finish(found);
}

}  // namespace quoin
