// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "core/geometry/pose.hpp"
#include "core/mapping/line_map.hpp"

namespace quoin::maps {

enum class Cell : std::uint8_t { free, occupied, unknown };

/// A map of cells, as ROS's map_server knows it.
struct OccupancyGrid {
  static constexpr std::size_t most_cells = 100'000'000;

  double resolution = 0.05;  ///< [m] of a cell
  Pose2 origin;              ///< of the lower left corner of the first cell
  std::size_t width = 0;
  std::size_t height = 0;
  std::vector<Cell> cells;  ///< row by row from the lowest, each from the left

  [[nodiscard]] Cell at(std::size_t column, std::size_t row) const {
    return cells[row * width + column];
  }
};

/// The grid that a .yaml describes, with its image: a PGM (P5 or P2). Throws MapError.
[[nodiscard]] OccupancyGrid read_grid(const std::filesystem::path& yaml);

/// The cells under these lines are occupied, with a margin of 1 m around all; what they enclose is
/// free, and what can be reached from outside without crossing one is unknown. Throws MapError for
/// more than `most_cells`.
[[nodiscard]] OccupancyGrid grid_of(std::span<const MapLine> lines, double resolution);

/// The image of a grid and its .yaml, which names the image.
[[nodiscard]] std::string pgm_of(const OccupancyGrid& grid);
[[nodiscard]] std::string png_of(const OccupancyGrid& grid);
[[nodiscard]] std::string yaml_of(const OccupancyGrid& grid, const std::string& image);

/// The walls of a grid: straight pieces of the borders between occupied and free cells, each by
/// least squares, with the free cells on the side that they are seen from. Pieces shorter than
/// 0.25 m are left out.
[[nodiscard]] std::vector<MapLine> vectorized(const OccupancyGrid& grid);

}  // namespace quoin::maps
