// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/ros2/occupancy_grid.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace quoin::ros2 {

namespace {

constexpr std::uint8_t occupied = 100;
constexpr std::uint8_t unknown = 255;  // -1
constexpr double margin = 1.0;         // [m]
constexpr double most_cells = 16e6;
constexpr double farthest = 1e6;  // [m] from the origin

bool usable(const MapLine& wall) {
  return wall.start.cwiseAbs().maxCoeff() < farthest && wall.end.cwiseAbs().maxCoeff() < farthest;
}

}  // namespace

void fill_grid(std::span<const MapLine> walls, const msg::Header& header, double resolution,
               OccupancyGrid& out) {
  Eigen::Vector2d low(0.0, 0.0);
  Eigen::Vector2d high(0.0, 0.0);
  for (const MapLine& wall : walls) {
    if (!usable(wall)) continue;
    low = low.cwiseMin(wall.start).cwiseMin(wall.end);
    high = high.cwiseMax(wall.start).cwiseMax(wall.end);
  }
  low.array() -= margin;
  const Eigen::Vector2d size = high - low + Eigen::Vector2d::Constant(margin);
  while (std::ceil(size.x() / resolution) * std::ceil(size.y() / resolution) > most_cells) {
    resolution *= 2.0;
  }
  const auto width = static_cast<std::uint32_t>(std::ceil(size.x() / resolution));
  const auto height = static_cast<std::uint32_t>(std::ceil(size.y() / resolution));
  set_header(out.header(), header.stamp(), header.frame());
  out.info().map_load_time(out.header().stamp());
  out.info().resolution(static_cast<float>(resolution));
  out.info().width(width);
  out.info().height(height);
  out.info().origin().position().x(low.x());
  out.info().origin().position().y(low.y());
  out.info().origin().orientation().w(1.0);
  out.data().assign(std::size_t{width} * height, unknown);
  for (const MapLine& wall : walls) {
    if (!usable(wall)) continue;
    // Twice a cell, so that none that it passes through for long is missed.
    const auto steps = static_cast<std::uint64_t>(std::ceil(2.0 * wall.length() / resolution)) + 1;
    for (std::uint64_t i = 0; i <= steps; ++i) {
      const double along = static_cast<double>(i) / static_cast<double>(steps);
      const Eigen::Vector2d cell =
          (wall.start + along * (wall.end - wall.start) - low) / resolution;
      const auto column = std::min(static_cast<std::uint32_t>(cell.x()), width - 1);
      const auto row = std::min(static_cast<std::uint32_t>(cell.y()), height - 1);
      out.data()[std::size_t{row} * width + column] = occupied;
    }
  }
}

}  // namespace quoin::ros2
