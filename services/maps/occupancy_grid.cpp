// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/maps/occupancy_grid.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>

#include <yaml-cpp/yaml.h>
#include <zlib.h>

#include "services/maps/map_file.hpp"

namespace quoin::maps {

namespace {

// Of map_server: what it writes and how it reads.
constexpr unsigned char free_gray = 254;
constexpr unsigned char occupied_gray = 0;
constexpr unsigned char unknown_gray = 205;

unsigned char gray_of(Cell cell) {
  return cell == Cell::free ? free_gray : cell == Cell::occupied ? occupied_gray : unknown_gray;
}

struct Image {
  std::size_t width = 0;
  std::size_t height = 0;
  double highest = 255.0;
  std::vector<double> gray;  // from the top
};

/// A portable gray map, P5 (bytes) or P2 (text).
Image parse_pgm(const std::string& text, const std::string& file) {
  std::size_t at = 0;
  const auto number = [&]() -> std::size_t {
    while (at < text.size() &&
           (std::isspace(static_cast<unsigned char>(text[at])) != 0 || text[at] == '#')) {
      if (text[at] == '#') at = std::min(text.find('\n', at), text.size());
      if (at < text.size()) ++at;
    }
    std::size_t value = 0;
    const auto [end, error] = std::from_chars(text.data() + at, text.data() + text.size(), value);
    if (error != std::errc{}) throw MapError(file + ": is no PGM image, or cut off");
    at = static_cast<std::size_t>(end - text.data());
    return value;
  };
  if (!text.starts_with("P5") && !text.starts_with("P2")) {
    throw MapError(file + ": is no PGM image; convert it to one (P5)");
  }
  const bool bytes = text[1] == '5';
  at = 2;
  Image image;
  image.width = number();
  image.height = number();
  const std::size_t highest = number();
  if (image.width == 0 || image.height == 0 || highest == 0 || highest > 255 ||
      image.width > OccupancyGrid::most_cells / image.height) {
    throw MapError(file + ": an image of " + std::to_string(image.width) + " x " +
                   std::to_string(image.height) + " with values up to " + std::to_string(highest) +
                   "; 1 to 100 million pixels of up to 255 are possible");
  }
  image.highest = static_cast<double>(highest);
  const std::size_t count = image.width * image.height;
  if (bytes) {
    ++at;
    if (text.size() < at || text.size() - at < count) throw MapError(file + ": is cut off");
    for (std::size_t i = 0; i < count; ++i) {
      image.gray.push_back(static_cast<unsigned char>(text[at + i]));
    }
  } else {
    if (text.size() < count) throw MapError(file + ": is cut off");
    for (std::size_t i = 0; i < count; ++i) image.gray.push_back(static_cast<double>(number()));
  }
  return image;
}

template <class T>
T value_of(const YAML::Node& node, const char* key, const std::string& file,
           const std::optional<T>& otherwise = {}) {
  if (!node[key] && otherwise) return *otherwise;
  try {
    return node[key].as<T>();
  } catch (const YAML::Exception&) {
    throw MapError(file + ": '" + key + "' is missing or not what map_server writes");
  }
}

void append_big(std::string& out, std::uint32_t value) {
  for (int shift = 24; shift >= 0; shift -= 8) out += static_cast<char>(value >> shift & 255U);
}

void append_chunk(std::string& png, const char* type, const std::string& content) {
  append_big(png, static_cast<std::uint32_t>(content.size()));
  const std::string checked = type + content;
  png += checked;
  append_big(png,
             static_cast<std::uint32_t>(::crc32(0, reinterpret_cast<const Bytef*>(checked.data()),
                                                static_cast<uInt>(checked.size()))));
}

}  // namespace

OccupancyGrid read_grid(const std::filesystem::path& yaml) {
  const std::string file = yaml.string();
  YAML::Node node;
  try {
    node = YAML::Load(read_text(yaml));
  } catch (const YAML::Exception& error) {
    throw MapError(file + ":" + std::to_string(error.mark.line + 1) + ": " + error.msg);
  }
  if (!node.IsMap()) throw MapError(file + ":1: this is no description of an occupancy grid");
  OccupancyGrid grid;
  grid.resolution = value_of<double>(node, "resolution", file);
  const auto origin = value_of<std::vector<double>>(node, "origin", file);
  const auto occupied = value_of<double>(node, "occupied_thresh", file, 0.65);
  const auto free = value_of<double>(node, "free_thresh", file, 0.196);
  const bool negated = value_of<int>(node, "negate", file, 0) != 0;
  if (!(grid.resolution > 1e-4 && grid.resolution < 100.0) || origin.size() < 3 ||
      !std::isfinite(origin[0] + origin[1] + origin[2])) {
    throw MapError(file + ": a resolution between 0.1 mm and 100 m, and an origin [x, y, yaw]");
  }
  grid.origin = {origin[0], origin[1], origin[2]};
  const std::filesystem::path image_file =
      yaml.parent_path() / value_of<std::string>(node, "image", file);
  const Image image = parse_pgm(read_text(image_file), image_file.string());
  grid.width = image.width;
  grid.height = image.height;
  grid.cells.resize(image.gray.size());
  for (std::size_t row = 0; row < grid.height; ++row) {
    for (std::size_t column = 0; column < grid.width; ++column) {
      const double gray = image.gray[(grid.height - 1 - row) * grid.width + column] / image.highest;
      const double occupancy = negated ? gray : 1.0 - gray;
      grid.cells[row * grid.width + column] = occupancy > occupied ? Cell::occupied
                                              : occupancy < free   ? Cell::free
                                                                   : Cell::unknown;
    }
  }
  return grid;
}

OccupancyGrid grid_of(std::span<const MapLine> lines, double resolution) {
  constexpr double margin = 1.0;  // [m]
  if (lines.empty()) throw MapError("a map without lines has no grid");
  Eigen::Vector2d low = lines.front().start, high = low;
  for (const MapLine& line : lines) {
    low = low.cwiseMin(line.start).cwiseMin(line.end);
    high = high.cwiseMax(line.start).cwiseMax(line.end);
  }
  OccupancyGrid grid;
  grid.resolution = resolution;
  grid.origin = {low.x() - margin, low.y() - margin, 0.0};
  const Eigen::Vector2d size = (high - low).array() + 2.0 * margin;
  const double columns = std::ceil(size.x() / resolution), rows = std::ceil(size.y() / resolution);
  if (!(columns * rows <= static_cast<double>(OccupancyGrid::most_cells))) {
    throw MapError("a grid of more than 100 million cells; take a larger resolution");
  }
  grid.width = static_cast<std::size_t>(columns);
  grid.height = static_cast<std::size_t>(rows);
  grid.cells.assign(grid.width * grid.height, Cell::free);
  for (const MapLine& line : lines) {
    // Steps of half a cell leave no hole for the flood below, which goes straight only.
    const auto steps = static_cast<std::size_t>(std::ceil(2.0 * line.length() / resolution)) + 1;
    for (std::size_t i = 0; i <= steps; ++i) {
      const double part = static_cast<double>(i) / static_cast<double>(steps);
      const Eigen::Vector2d point = line.start + part * (line.end - line.start);
      const auto column = static_cast<std::size_t>((point.x() - grid.origin.x) / resolution);
      const auto row = static_cast<std::size_t>((point.y() - grid.origin.y) / resolution);
      grid.cells[std::min(row, grid.height - 1) * grid.width + std::min(column, grid.width - 1)] =
          Cell::occupied;
    }
  }
  // The margin is outside.
  std::vector<std::size_t> left{0};
  grid.cells[0] = Cell::unknown;
  while (!left.empty()) {
    const std::size_t cell = left.back();
    left.pop_back();
    const std::size_t column = cell % grid.width, row = cell / grid.width;
    const auto visit = [&](std::size_t next) {
      if (grid.cells[next] != Cell::free) return;
      grid.cells[next] = Cell::unknown;
      left.push_back(next);
    };
    if (column > 0) visit(cell - 1);
    if (column + 1 < grid.width) visit(cell + 1);
    if (row > 0) visit(cell - grid.width);
    if (row + 1 < grid.height) visit(cell + grid.width);
  }
  return grid;
}

std::string pgm_of(const OccupancyGrid& grid) {
  std::string text =
      "P5\n" + std::to_string(grid.width) + " " + std::to_string(grid.height) + "\n255\n";
  for (std::size_t row = grid.height; row-- > 0;) {
    for (std::size_t column = 0; column < grid.width; ++column) {
      text += static_cast<char>(gray_of(grid.at(column, row)));
    }
  }
  return text;
}

std::string png_of(const OccupancyGrid& grid) {
  std::string rows;
  for (std::size_t row = grid.height; row-- > 0;) {
    rows += '\0';  // without a filter
    for (std::size_t column = 0; column < grid.width; ++column) {
      rows += static_cast<char>(gray_of(grid.at(column, row)));
    }
  }
  uLongf size = ::compressBound(static_cast<uLong>(rows.size()));
  std::string packed(size, '\0');
  if (::compress(reinterpret_cast<Bytef*>(packed.data()), &size,
                 reinterpret_cast<const Bytef*>(rows.data()),
                 static_cast<uLong>(rows.size())) != Z_OK) {
    throw MapError("the image cannot be compressed");
  }
  packed.resize(size);
  std::string png = "\x89PNG\r\n\x1a\n";
  std::string header;
  append_big(header, static_cast<std::uint32_t>(grid.width));
  append_big(header, static_cast<std::uint32_t>(grid.height));
  header += std::string("\x08\x00\x00\x00\x00", 5);  // 8 bits of gray
  append_chunk(png, "IHDR", header);
  append_chunk(png, "IDAT", packed);
  append_chunk(png, "IEND", "");
  return png;
}

std::string yaml_of(const OccupancyGrid& grid, const std::string& image) {
  const auto text = [](double value) {
    std::array<char, 32> digits{};
    const auto [end, error] = std::to_chars(digits.data(), digits.data() + digits.size(), value);
    return std::string(digits.data(), end);
  };
  return "image: " + image + "\nresolution: " + text(grid.resolution) + "\norigin: [" +
         text(grid.origin.x) + ", " + text(grid.origin.y) + ", " + text(grid.origin.theta) +
         "]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n";
}

}  // namespace quoin::maps
