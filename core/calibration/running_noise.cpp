// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/calibration/running_noise.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/calibration/variance_components.hpp"
#include "core/statistics/chi_square.hpp"
#include "core/statistics/order_statistics.hpp"

namespace quoin {
namespace {

// The median of so many walls is known to a tenth.
constexpr std::size_t fewest_walls = 100;
// From block to block of recorded scans, with the rooms that a robot drives through, the noise
// changes by up to 1.35 times.
constexpr double jump = 1.5;
// [m] No range is told apart by less. Scans without noise, of simulators, would otherwise give
// lines and corners with covariances of 0, which no filter can use, and no noise could be compared
// with the next.
constexpr double least_range_stddev = 1e-4;

/// Residuals of the walls of scans [begin, end) about lines that are fitted under the model.
ResidualTable residuals_of(const WallSample& sample, std::size_t begin, std::size_t end,
                           const SensorModel& model) {
  ResidualTable table;
  Points points;
  for (const WallSample::Wall& wall : sample.walls()) {
    if (wall.scan < begin || wall.scan >= end) continue;
    sample.points_of(wall, points);
    table.add(points, model);
  }
  return table;
}

double noise_factor(const ResidualTable& table, const SensorModel& model) {
  std::vector<double> reduced;
  for (const WallResiduals& wall : table.walls()) {
    reduced.push_back(chi_square(table, wall, model) / median_chi_square(wall.points - 2.0));
  }
  return std::sqrt(median(std::move(reduced)));
}

}  // namespace

RunningNoise::Event RunningNoise::add(const PointsView& points, std::span<const Segment> walls) {
  window_.add(scan_++, points, walls);
  for (const Segment& wall : walls) {
    if (wall.size() >= WallSample::fewest_points) block_points_ += wall.size();
  }
  if (block_points_ < settings_.block_points) return Event::none;

  const std::size_t begin = block_begin_;
  const SensorModel start = components_ ? components_->model() : SensorModel{};
  const ResidualTable block = residuals_of(window_, begin, scan_, start);
  if (block.walls().size() < fewest_walls) return Event::none;
  block_begin_ = scan_;
  block_points_ = 0;

  Event event = Event::renewed;
  if (components_) {
    const double factor = noise_factor(block, start);
    if (factor > jump || factor < 1.0 / jump) {
      event = Event::jump;
      window_.forget_before(begin);
    }
  }
  while (window_.ranges().size() > settings_.window_points &&
         window_.walls().front().scan < begin) {
    window_.forget_before(window_.walls().front().scan + 1);
  }
  SensorModel model = start;
  // The lines change little with the model, unless there was none.
  const int rounds = components_ && event != Event::jump ? 1 : 3;
  for (int round = 0; round < rounds; ++round) {
    const ResidualTable all = residuals_of(window_, 0, scan_, model);
    components_ = find_components(all, all.walls(), model);
    components_->range_stddev = std::max(components_->range_stddev, least_range_stddev);
    model = components_->model();
  }
  return event;
}

}  // namespace quoin
