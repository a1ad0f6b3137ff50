// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/segmentation/block_test.hpp"

#include <algorithm>
#include <cmath>

#include "core/fitting/orthogonal.hpp"

namespace quoin {
namespace {

constexpr std::size_t many_points = 32;
constexpr std::size_t few_blocks = 4;
/// Of chi square with two degrees of freedom less than there are blocks.
struct Limits {
  double many, few;
};
constexpr Limits limits_of_long{22.458, 13.816};  // exceeded once in 1000 times
constexpr Limits limits_of_short{16.812, 9.210};  // once in 100 times: clutter is short
constexpr double bow_of_a_wall = 0.01;            // of a wall, over its length

std::size_t block_count(std::size_t points) {
  return points >= many_points ? most_blocks : std::min(points, few_blocks);
}

/// Side by side, so that no sum waits for its own last addition. Blocks differ by one point at
/// most.
template <std::size_t blocks>
inline void add_blocks(const double* __restrict x, const double* __restrict y, std::size_t count,
                       BlockMean* out) {
  std::array<std::size_t, blocks + 1> begin{};
  for (std::size_t b = 0; b <= blocks; ++b) begin[b] = count * b / blocks;
  std::array<double, blocks> sum_x{};
  std::array<double, blocks> sum_y{};
  const std::size_t shortest = count / blocks;
  for (std::size_t k = 0; k < shortest; ++k) {
    for (std::size_t b = 0; b < blocks; ++b) {
      sum_x[b] += x[begin[b] + k];
      sum_y[b] += y[begin[b] + k];
    }
  }
  const auto weight = static_cast<double>(shortest);
  const double scale = 1.0 / weight;
  const double scale_of_longer = 1.0 / (weight + 1.0);
  for (std::size_t b = 0; b < blocks; ++b) {
    if (begin[b] + shortest == begin[b + 1]) {
      out[b] = {sum_x[b] * scale, sum_y[b] * scale, weight};
    } else {
      const std::size_t last = begin[b] + shortest;
      out[b] = {(sum_x[b] + x[last]) * scale_of_longer, (sum_y[b] + y[last]) * scale_of_longer,
                weight + 1.0};
    }
  }
}

}  // namespace

BlockMeans::BlockMeans(const PointsView& points, const Segment& segment)
    : count_(block_count(segment.size())) {
  const double* const x = &points.x[segment.begin];
  const double* const y = &points.y[segment.begin];
  if (count_ == most_blocks) {
    add_blocks<most_blocks>(x, y, segment.size(), means_.data());
  } else if (count_ == few_blocks) {
    add_blocks<few_blocks>(x, y, segment.size(), means_.data());
  } else {
    for (std::size_t i = 0; i < count_; ++i) means_[i] = {x[i], y[i], 1.0};
  }
  add_up();
}

BlockMeans::BlockMeans(const PointsView& points, std::span<const std::size_t> indices)
    : count_(block_count(indices.size())) {
  for (std::size_t k = 0; k < indices.size(); ++k) {
    BlockMean& mean = means_.at(k * count_ / indices.size());
    mean.weight += 1.0;
    mean.x += (points.x[indices[k]] - mean.x) / mean.weight;
    mean.y += (points.y[indices[k]] - mean.y) / mean.weight;
  }
  add_up();
}

void BlockMeans::add_up() {
  for (const BlockMean& mean : means()) moments_.add(mean.x, mean.y, mean.weight);
}

BlockTest test_blocks(const BlockMeans& blocks, const SensorModel& sensor, double flatness) {
  BlockTest test;
  const std::span<const BlockMean> means = blocks.means();
  const OrthogonalLine fit = orthogonal_line(blocks.moments());
  test.line = fit.line;
  if (!fit.ok() || blocks.moments().weight <= few_blocks) return test;

  double farthest = 0.0;
  for (const BlockMean& mean : means) {
    farthest = std::max(farthest, std::abs(fit.line.distance(mean.x, mean.y)));
  }
  const double first = fit.line.along(means.front().x, means.front().y);
  const double last = fit.line.along(means.back().x, means.back().y);
  const double length = std::abs(last - first);
  if (farthest <= std::min(flatness, bow_of_a_wall * length)) return test;

  double chi_square = 0.0;
  for (const BlockMean& mean : means) {
    const double distance = fit.line.distance(mean.x, mean.y);
    const double along = fit.line.along(mean.x, mean.y);
    const double range = fit.line.offset * sensor.range_stddev;
    const double bearing = along * sensor.bearing_stddev;
    const double growing = fit.line.offset * sensor.range_stddev_per_metre;
    const double variance =
        range * range / (mean.x * mean.x + mean.y * mean.y) + growing * growing + bearing * bearing;
    chi_square += mean.weight * distance * distance / variance;
  }
  const Limits& limits = length < short_wall ? limits_of_short : limits_of_long;
  test.crooked = chi_square > (means.size() == most_blocks ? limits.many : limits.few);
  return test;
}

}  // namespace quoin
