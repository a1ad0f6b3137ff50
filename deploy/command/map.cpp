// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include <cstdio>
#include <filesystem>
#include <memory>

#include "deploy/command/commands.hpp"
#include "services/maps/map_reader.hpp"
#include "services/maps/map_writer.hpp"
#include "services/maps/occupancy_grid.hpp"

namespace quoin::deploy {

namespace {

struct MapOptions {
  std::string input;
  std::vector<std::string> outputs;
  double scale = 1.0;
  double resolution = 0.05;
};

/// An image of the grid, and the .yaml beside it.
void write_map_grid(const maps::SavedMap& map, const std::filesystem::path& image,
                    const MapOptions& options) {
  const maps::OccupancyGrid grid = maps::grid_of(map.lines, options.resolution);
  maps::write_whole(image, image.extension() == ".png" ? maps::png_of(grid) : maps::pgm_of(grid));
  std::filesystem::path yaml = image;
  yaml.replace_extension(".yaml");
  maps::write_whole(yaml, maps::yaml_of(grid, image.filename().string()));
  std::printf("%s: %zu x %zu cells of %g m, described by %s\n", image.c_str(), grid.width,
              grid.height, grid.resolution, yaml.c_str());
}

void write_map(const maps::SavedMap& map, const std::filesystem::path& file,
               const MapOptions& options) {
  const std::string end = file.extension().string();
  if (end == ".pgm" || end == ".png") return write_map_grid(map, file, options);
  std::string text;
  if (end == ".svg") {
    text = maps::svg_of(map);
  } else if (end == ".json") {
    text = maps::json_of(map);
  } else if (end == ".geojson") {
    text = maps::geojson_of(map);
  } else if (end == ".dxf") {
    text = maps::dxf_of(map);
  } else {
    throw maps::MapError(file.string() +
                         ": a map is written as .svg, .json, .geojson, .dxf, .pgm or .png");
  }
  maps::write_whole(file, text);
  std::printf("%s: %zu walls\n", file.c_str(), map.lines.size());
}

int run_map(const MapOptions& options) try {
  const maps::SavedMap map = maps::read_map(options.input, options.scale);
  double length = 0.0;
  for (const MapLine& line : map.lines) length += line.length();
  std::printf("%s: %zu walls of %.1f m in the frame %s%s\n", options.input.c_str(),
              map.lines.size(), length, map.frame.c_str(),
              map.method.empty() ? "" : (", by " + map.method).c_str());
  for (const std::string& file : options.outputs) write_map(map, file, options);
  return exit_ok;
} catch (const maps::MapError& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return exit_input;
}

}  // namespace

Command add_map(CLI::App& app) {
  auto options = std::make_shared<MapOptions>();
  CLI::App* line = app.add_subcommand(
      "map",
      "Say what a map holds, and write it as a drawing (.svg, .dxf), as data (.json, .geojson) or "
      "as an occupancy grid (.pgm or .png, with the .yaml that map_server reads)");
  line->add_option("map", options->input,
                   "map of kind mapping (.qmap), plan (.svg, .dxf) or occupancy grid (.yaml)")
      ->required();
  line->add_option("-o,--output", options->outputs,
                   "file to write, whose ending is the format; may be given several times");
  line->add_option("--scale", options->scale,
                   "length [m] of one unit of a drawing that names no unit")
      ->check(more_than_zero())
      ->capture_default_str();
  line->add_option("--resolution", options->resolution, "size [m] of the cells of a grid")
      ->check(more_than_zero())
      ->capture_default_str();
  return {line, [options] { return run_map(*options); }};
}

}  // namespace quoin::deploy
