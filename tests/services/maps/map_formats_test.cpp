// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "services/maps/map_reader.hpp"
#include "services/maps/map_writer.hpp"
#include "services/maps/occupancy_grid.hpp"
#include "tests/sensor_bridge/error_of.hpp"
#include "tests/temporary_folder.hpp"

namespace quoin::maps {
namespace {

using quoin::tests::error_of;
using quoin::tests::TemporaryFolder;
using testing::HasSubstr;

MapLine wall(double x1, double y1, double x2, double y2) {
  MapLine line;
  line.start = {x1, y1};
  line.end = {x2, y2};
  return line;
}

/// A room of 5 m x 3.5 m that is turned by `angle` [rad], its walls seen from inside.
SavedMap room(double angle = 0.0) {
  const Pose2 turn{1.0, 2.0, angle};
  const std::vector<Eigen::Vector2d> corners{{-2, -1.5}, {3, -1.5}, {3, 2}, {-2, 2}};
  SavedMap map;
  for (std::size_t i = 0; i < 4; ++i) {
    MapLine line;
    line.id = i;
    line.start = turn.transform(corners[i]);
    line.end = turn.transform(corners[(i + 1) % 4]);
    line.observations = 1;
    map.lines.push_back(line);
  }
  return map;
}

void expect_same_walls(const std::vector<MapLine>& found, const std::vector<MapLine>& expected) {
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    EXPECT_LT((found[i].start - expected[i].start).norm(), 1e-4) << i;
    EXPECT_LT((found[i].end - expected[i].end).norm(), 1e-4) << i;
  }
}

TEST(Svg, ReadsWhatItWrites) {
  const SavedMap map = room(0.3);
  expect_same_walls(parse_svg(svg_of(map), "a.svg", 1.0), map.lines);
}

TEST(Svg, ReadsTheElementsOfAPlan) {
  const auto lines = parse_svg(R"(<?xml version="1.0"?>
<!-- <line x1="9" y1="9" x2="8" y2="8"/> -->
<svg xmlns="http://www.w3.org/2000/svg">
<line x1="0" y1="0" x2="100" y2="0"/>
<polyline points="0,0 0,50 10 50"/>
<polygon points="0,0 10,0 0,10"/>
<rect x="1" y="2" width="3" height="4"/>
<path d="M10 10 h5v-5 L0,0z m1 1 l2,0 C 1 1 2 2 3 3 l1 0"/>
<text x="3" y="4">hall</text>
</svg>)",
                               "a.svg", 0.01);
  ASSERT_EQ(lines.size(), 1U + 2U + 3U + 4U + 4U + 1U + 1U);
  EXPECT_NEAR(lines[0].end.x(), 1.0, 1e-12);
  EXPECT_NEAR(lines[2].start.y(), -0.5, 1e-12) << "y points down";
  EXPECT_EQ(lines[0].observations, 0U) << "a plan's";
  const MapLine& last = lines.back();
  EXPECT_NEAR(last.start.x(), 0.03, 1e-12) << "where the curve ends";
  EXPECT_NEAR(last.end.x(), 0.04, 1e-12);
}

TEST(Svg, SaysWhatItCannotRead) {
  const auto error = [](const char* text) {
    return error_of<MapError>([&] { (void)parse_svg(text, "a.svg", 1.0); });
  };
  EXPECT_THAT(error("<svg>\n<g transform=\"scale(2)\"><line x2=\"1\"/></g></svg>"),
              HasSubstr("a.svg:2: a transform"));
  EXPECT_THAT(error("<svg>\n<line x1=\"1mm\"/></svg>"), HasSubstr("a.svg:2: x1 is '1mm'"));
  EXPECT_THAT(error("<svg><polyline points=\"1 2 3\"/></svg>"), HasSubstr("odd number"));
  EXPECT_THAT(error("<svg><line x2=\"1e9\"/></svg>"), HasSubstr("1000 km"));
  EXPECT_THAT(error("<svg><line"), HasSubstr("cut off"));
  EXPECT_THAT(error("<html>"), HasSubstr("no SVG"));
}

TEST(Dxf, ReadsWhatItWrites) {
  const SavedMap map = room(0.3);
  expect_same_walls(parse_dxf(dxf_of(map), "a.dxf", 7.0), map.lines);
}

TEST(Dxf, ReadsPolylinesInTheUnitOfTheDrawing) {
  const std::string header = "0\nSECTION\n2\nHEADER\n9\n$INSUNITS\n70\n4\n0\nENDSEC\n";
  const std::string entities =
      "0\nSECTION\n2\nENTITIES\n"
      "0\nLWPOLYLINE\n8\n0\n90\n3\n70\n1\n10\n0\n20\n0\n10\n1000\n20\n0\n10\n1000\n20\n500\n"
      "0\nPOLYLINE\n10\n0\n20\n0\n70\n0\n0\nVERTEX\n10\n5\n20\n5\n0\nVERTEX\n10\n5\n20\n2005\n"
      "0\nSEQEND\n0\nCIRCLE\n10\n1\n20\n1\n40\n3\n0\nENDSEC\n0\nEOF\n";
  const auto lines = parse_dxf(header + entities, "a.dxf", 1.0);
  expect_same_walls(lines, {wall(0, 0, 1, 0), wall(1, 0, 1, 0.5), wall(1, 0.5, 0, 0),
                            wall(0.005, 0.005, 0.005, 2.005)});
  expect_same_walls({parse_dxf(entities, "a.dxf", 0.01).front()}, {wall(0, 0, 10, 0)});
}

TEST(Dxf, SaysWhatItCannotRead) {
  const auto error = [](const char* text) {
    return error_of<MapError>([&] { (void)parse_dxf(text, "a.dxf", 1.0); });
  };
  EXPECT_THAT(error("AutoCAD Binary DXF"), HasSubstr("save it as text"));
  EXPECT_THAT(error("0\nSECTION\nfoo\nbar\n"), HasSubstr("a.dxf:3: 'foo' is no group code"));
  EXPECT_THAT(error("0\nSECTION\n2"), HasSubstr("cut off"));
  EXPECT_THAT(error("0\nSECTION\n2\nENTITIES\n0\nLINE\n10\nx\n"), HasSubstr("a.dxf:8: 'x'"));
}

TEST(Json, HasTheWalls) {
  const auto json = nlohmann::json::parse(json_of(room()));
  EXPECT_EQ(json["frame"], "map");
  EXPECT_EQ(json["walls"].size(), 4U);
  EXPECT_EQ(json["walls"][0]["end"][0], 4.0);
  const auto geojson = nlohmann::json::parse(geojson_of(room()));
  EXPECT_EQ(geojson["type"], "FeatureCollection");
  EXPECT_EQ(geojson["features"][1]["geometry"]["coordinates"][0][0], 4.0);
}

TEST(Grid, EnclosesWhatIsFree) {
  const OccupancyGrid grid = grid_of(room().lines, 0.1);
  EXPECT_EQ(grid.width, 70U);
  EXPECT_EQ(grid.height, 55U);
  EXPECT_EQ(grid.at(0, 0), Cell::unknown);
  EXPECT_EQ(grid.at(35, 27), Cell::free);
  EXPECT_EQ(grid.at(35, 10), Cell::occupied);
  const auto free = std::ranges::count(grid.cells, Cell::free);
  EXPECT_NEAR(static_cast<double>(free) * 0.01, 5.0 * 3.5, 1.0);
  SavedMap open = room();
  open.lines.pop_back();
  EXPECT_EQ(std::ranges::count(grid_of(open.lines, 0.1).cells, Cell::free), 0);
  EXPECT_THROW((void)grid_of(room().lines, 1e-5), MapError);
  EXPECT_THROW((void)grid_of({}, 0.1), MapError);
}

class GridOfATurnedRoom : public testing::TestWithParam<double> {};

TEST_P(GridOfATurnedRoom, GivesItsWallsBack) {
  const SavedMap map = room(GetParam());
  const TemporaryFolder folder;
  constexpr double cell = 0.05;
  const OccupancyGrid drawn = grid_of(map.lines, cell);
  folder.write("grid.pgm", pgm_of(drawn));
  const auto yaml = folder.write("grid.yaml", yaml_of(drawn, "grid.pgm"));
  const OccupancyGrid read = read_grid(yaml);
  EXPECT_EQ(read.cells, drawn.cells);
  EXPECT_EQ(read.origin.x, drawn.origin.x);
  const std::vector<MapLine> found = read_map(yaml, 1.0).lines;
  ASSERT_EQ(found.size(), 4U) << "what is outside is unknown, and has no border";
  for (const MapLine& wall : map.lines) {
    const auto same = std::ranges::find_if(found, [&](const MapLine& line) {
      return std::abs(std::remainder(line.direction() - wall.direction(), 2 * std::numbers::pi)) <
             0.02;
    });
    ASSERT_NE(same, found.end()) << "with the free side where it was seen from";
    const Eigen::Vector2d along = (wall.end - wall.start).normalized();
    for (const Eigen::Vector2d& end : {same->start, same->end}) {
      const Eigen::Vector2d off = end - wall.start;
      EXPECT_LT(std::abs(along.x() * off.y() - along.y() * off.x()), 1.5 * cell);
    }
    EXPECT_NEAR(same->length(), wall.length(), 6 * cell);
  }
}

INSTANTIATE_TEST_SUITE_P(Angles, GridOfATurnedRoom,
                         testing::Values(0.0, 0.1, 0.5, std::numbers::pi / 4, 1.3));

TEST(Grid, SaysWhatItCannotRead) {
  const TemporaryFolder folder;
  const auto error = [&](const std::string& yaml, const std::string& image) {
    folder.write("a.pgm", image);
    const auto file = folder.write("a.yaml", yaml);
    return error_of<MapError>([&] { (void)read_grid(file); });
  };
  const std::string good = "image: a.pgm\nresolution: 0.05\norigin: [0, 0, 0]\n";
  EXPECT_THAT(error("[", ""), HasSubstr("a.yaml:1"));
  EXPECT_THAT(error("image: a.pgm\n", ""), HasSubstr("'resolution' is missing"));
  EXPECT_THAT(error(good, "P6 1 1 255\n"), HasSubstr("a.pgm: is no PGM"));
  EXPECT_THAT(error(good, "P5 2 2 255\nabc"), HasSubstr("cut off"));
  EXPECT_THAT(error(good, "P5 99999999 99999999 255\n"), HasSubstr("100 million"));
  EXPECT_THAT(error("image: none.pgm\nresolution: 0.05\norigin: [0, 0, 0]\n", ""),
              HasSubstr("none.pgm: cannot be read"));
}

TEST(Png, IsOne) {
  const std::string png = png_of(grid_of(room().lines, 0.1));
  EXPECT_EQ(png.substr(0, 8), "\x89PNG\r\n\x1a\n");
  EXPECT_EQ(png.substr(12, 4), "IHDR");
  EXPECT_EQ(png.substr(png.size() - 8, 4), "IEND");
  EXPECT_EQ(static_cast<unsigned char>(png[19]), 70U);
}

TEST(ReadMap, KnowsFormatsByTheirNames) {
  const TemporaryFolder folder;
  EXPECT_EQ(read_map(folder.write("a.qmap", map_text(room())), 1.0).lines.size(), 4U);
  EXPECT_EQ(read_map(folder.write("a.svg", svg_of(room())), 1.0).lines.size(), 4U);
  EXPECT_EQ(read_map(folder.write("a.dxf", dxf_of(room())), 1.0).lines.size(), 4U);
  const auto error = [](const std::filesystem::path& file) {
    return error_of<MapError>([&] { (void)read_map(file, 1.0); });
  };
  EXPECT_THAT(error(folder.write("a.txt", "")), HasSubstr("a map is a .qmap"));
  EXPECT_THAT(error(folder.write("b.svg", "<svg></svg>")), HasSubstr("no lines in it"));
  EXPECT_THAT(error(folder.path() / "none.svg"), HasSubstr("none.svg: cannot be read"));
}

}  // namespace
}  // namespace quoin::maps
