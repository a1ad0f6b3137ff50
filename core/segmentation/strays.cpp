// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/segmentation/strays.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "core/sensor/multiversion.hpp"
#include "core/statistics/order_statistics.hpp"

namespace quoin {
namespace {

constexpr int fewest_equal = 8;
// By so many standard deviations must the range of a flat wall vary over a run.
constexpr double deviations_of_variation = 4.0;

constexpr std::size_t sampled_triples = 64;
constexpr std::size_t fewest_triples = 16;
constexpr double median_of_normal = 0.6744897501960817;  // of the absolute value, sigma 1

QUOIN_MULTIVERSION
void count_equal(const double* values, std::size_t count, std::int64_t& out) {
  std::int64_t sum = 0;
  for (std::size_t i = 1; i < count; ++i) sum += values[i] == values[i - 1] ? 1 : 0;
  out = sum;
}

/// How far the ranges of a flat wall differ at least when it is seen between these points, its
/// nearest point in the middle [m].
double variation_of_wall(const PointsView& points, const Segment& run) {
  const std::size_t last = run.end - 1;
  const double cosine =
      points.cosine[run.begin] * points.cosine[last] + points.sine[run.begin] * points.sine[last];
  const double cosine_of_half = std::sqrt(0.5 * (1.0 + std::min(cosine, 1.0)));
  return points.range[run.begin] * (1.0 - cosine_of_half);
}

}  // namespace

void find_fill(const PointsView& points, const SensorModel& sensor,
               std::vector<std::size_t>& fill) {
  const std::span<const double> range = points.range;
  std::int64_t equal = 0;
  count_equal(range.data(), range.size(), equal);
  if (equal + 1 < fewest_equal) return;

  // A point of each such run stands in `fill` meanwhile.
  const auto first = static_cast<std::ptrdiff_t>(fill.size());
  for (std::size_t begin = 0; begin < range.size();) {
    std::size_t end = begin + 1;
    while (end < range.size() && range[end] == range[begin]) ++end;
    if (end - begin >= std::size_t{fewest_equal} &&
        variation_of_wall(points, {begin, end}) >
            deviations_of_variation * std::sqrt(sensor.range_variance(range[begin]))) {
      fill.push_back(begin);
    }
    begin = end;
  }
  const auto runs = static_cast<std::ptrdiff_t>(fill.size());
  if (runs == first) return;
  for (std::size_t i = 0; i < range.size(); ++i) {
    const auto same = [&](std::size_t run) { return range[run] == range[i]; };
    if (std::any_of(fill.begin() + first, fill.begin() + runs, same)) fill.push_back(i);
  }
  fill.erase(fill.begin() + first, fill.begin() + runs);
}

void pass_over_strays(const CoarsePoints& points, const BreakpointDetector& breakpoints,
                      std::size_t most, std::vector<Segment>& clusters,
                      std::vector<std::size_t>& strays) {
  std::size_t kept = 0;  // clusters, of points that are left
  std::size_t k = 0;
  while (k < clusters.size()) {
    Segment surface = clusters[k];
    const std::size_t before = strays.size();
    while (true) {
      const std::size_t on_surface = surface.size() - (strays.size() - before);
      std::size_t next = k + 1;
      std::size_t passed = 0;
      bool goes_on = false;
      while (next + 1 < clusters.size() && !goes_on) {
        passed += clusters[next].size();
        // Else the surface is the stray.
        if (passed > most || passed >= on_surface) break;
        ++next;
        goes_on = breakpoints.connected(points, surface.end - 1, clusters[next].begin);
      }
      if (!goes_on) break;
      for (std::size_t i = surface.end; i < clusters[next].begin; ++i) strays.push_back(i);
      surface.end = clusters[next].end;
      k = next;
    }
    clusters[kept++] = {surface.begin - before, surface.end - strays.size()};
    ++k;
  }
  clusters.resize(kept);
}

double range_noise(const PointsView& points) {
  if (points.size() < fewest_triples + 2) return 0.0;
  std::array<float, sampled_triples> errors{};
  const std::size_t available = points.size() - 2;
  const std::size_t count = std::min(available, sampled_triples);
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t i = 1 + k * available / count;
    // A cos + B sin of three bearings is linear with these weights.
    const double first = sine_between(points, i, i + 1);
    const double last = sine_between(points, i - 1, i);
    const double middle = sine_between(points, i - 1, i + 1);
    const double error = points.inverse_range[i - 1] * first + points.inverse_range[i + 1] * last -
                         points.inverse_range[i] * middle;
    const double scaled = error * points.range[i] * points.range[i];
    const double weights = middle * middle + first * first + last * last;
    errors[k] = weights > 0.0 ? static_cast<float>(std::abs(scaled) / std::sqrt(weights)) : 0.0F;
  }
  return static_cast<double>(approximate_median({errors.data(), count})) / median_of_normal;
}

double declared_range_noise(const PointsView& points, const SensorModel& sensor) {
  if (!(sensor.range_stddev_per_metre > 0.0) || points.size() == 0) return sensor.range_stddev;
  double sum = 0.0;
  for (const double range : points.range) sum += range * range;
  return std::sqrt(sensor.range_variance(std::sqrt(sum / static_cast<double>(points.size()))));
}

}  // namespace quoin
