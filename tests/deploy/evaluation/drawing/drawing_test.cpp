// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "deploy/evaluation/drawing/drawing.hpp"

#include <limits>
#include <string>
#include <vector>

#include <gmock/gmock.h>

#include "tests/deploy/evaluation/drawing/svg_elements.hpp"

namespace quoin::deploy {
namespace {

using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

Drawing room() {
  Drawing drawing;
  drawing.title = "corners <1>";
  drawing.caption = "front & walls";
  drawing.points = {{4.0, -1.0}, {4.0, 3.0}, {0.0, 3.0}};
  drawing.lines = {{{4.0, -1.0}, {4.0, 3.0}}, {{4.0, 3.0}, {0.0, 3.0}}};
  drawing.corners = {{{4.0, 3.0}, 0.02, 0.01, 0.5}};
  return drawing;
}

/// The points of the scan, without the one in the legend.
std::vector<DrawnPoint> points_of(const std::string& svg) {
  std::vector<DrawnPoint> points;
  for (const SvgElement& point : svg_elements(svg, "point")) {
    points.push_back({point.number("cx"), point.number("cy")});
  }
  points.pop_back();
  return points;
}

void expect_well_formed(const std::string& svg) {
  EXPECT_NO_THROW((void)svg_elements(svg));
  EXPECT_THAT(svg, Not(HasSubstr("nan")));
  EXPECT_THAT(svg, Not(HasSubstr("inf")));
}

TEST(Drawing, IsWellFormedAndEscaped) {
  const std::string svg = draw_svg(room());
  expect_well_formed(svg);
  EXPECT_THAT(svg, HasSubstr("corners &lt;1&gt;"));
  EXPECT_THAT(svg, HasSubstr("front &amp; walls"));
  EXPECT_THAT(svg, HasSubstr("3 points"));
  EXPECT_THAT(svg, HasSubstr("2 lines"));
  EXPECT_THAT(svg, HasSubstr("1 corners with 95 % ellipses"));
}

TEST(Drawing, ShowsCirclesToScaleWhereThereAreSome) {
  Drawing drawing = room();
  EXPECT_TRUE(svg_elements(draw_svg(drawing), "round").empty());
  EXPECT_THAT(draw_svg(drawing), Not(HasSubstr("circles")));
  drawing.circles = {{{{2.0, 1.0}, 0.02, 0.01, 0.5}, 0.5},
                     {{{2.0, 1.0}, 0.02, 0.01, 0.5}, std::numeric_limits<double>::quiet_NaN()}};
  const std::string svg = draw_svg(drawing);
  expect_well_formed(svg);
  EXPECT_THAT(svg, HasSubstr("2 circles"));
  const auto circles = svg_elements(svg, "round");
  ASSERT_EQ(circles.size(), 2U) << "one, and one in the legend";
  const auto points = points_of(svg);
  const double pixels_per_metre = (points[1].x - points[2].x) / 4.0;
  EXPECT_NEAR(circles[0].number("r"), 0.5 * pixels_per_metre, 0.02);
  EXPECT_NEAR(circles[0].number("cx"), points[2].x + 2.0 * pixels_per_metre, 0.02);
}

TEST(Drawing, PutsPointsWhereTheyAre) {
  const auto points = points_of(draw_svg(room()));
  ASSERT_EQ(points.size(), 3U);
  // Same scale on both axes, x to the right, y up: 4 m to the right are as long as 4 m up.
  EXPECT_NEAR(points[0].x, points[1].x, 0.02);
  EXPECT_NEAR(points[1].y, points[2].y, 0.02);
  EXPECT_GT(points[0].y, points[1].y);
  EXPECT_GT(points[1].x, points[2].x);
  EXPECT_NEAR(points[0].y - points[1].y, points[1].x - points[2].x, 0.04);
}

TEST(Drawing, PutsTheSensorAtTheOrigin) {
  const std::string svg = draw_svg(room());
  const auto points = points_of(svg);
  const SvgElement sensor = svg_elements(svg, "sensor").at(1);  // the first is its group
  EXPECT_NEAR(sensor.number("cx"), points[2].x, 0.02);
  EXPECT_NEAR(sensor.number("cy"), points[0].y - (points[0].y - points[1].y) / 4.0, 0.02);
}

TEST(Drawing, JoinsTheEndsOfLines) {
  const std::string svg = draw_svg(room());
  const auto points = points_of(svg);
  const auto lines = svg_elements(svg, "fitted");
  ASSERT_EQ(lines.size(), 3U);  // the last is in the legend
  EXPECT_NEAR(lines[0].number("x1"), points[0].x, 0.02);
  EXPECT_NEAR(lines[0].number("y2"), points[1].y, 0.02);
  EXPECT_NEAR(lines[1].number("x2"), points[2].x, 0.02);
}

TEST(Drawing, EllipsesHaveSizeDirectionAndScale) {
  DrawingOptions options;
  options.ellipse_scale = 10.0;
  const std::string svg = draw_svg(room(), options);
  const auto points = points_of(svg);
  const double pixels_per_metre = (points[1].x - points[2].x) / 4.0;
  const SvgElement ellipse = svg_elements(svg, "uncertainty").at(0);
  EXPECT_NEAR(ellipse.number("cx"), points[1].x, 0.02);
  EXPECT_NEAR(ellipse.number("rx"), 0.2 * pixels_per_metre, 0.02);
  EXPECT_NEAR(ellipse.number("ry"), 0.1 * pixels_per_metre, 0.02);
  // 0.5 rad counter-clockwise, in degrees and in a frame whose y axis points down.
  EXPECT_THAT(ellipse.attributes.at("transform"), StartsWith("rotate(-28.65 "));
  EXPECT_THAT(svg, HasSubstr("enlarged 10 times"));
  options.ellipse_scale = 1.0;
  EXPECT_THAT(draw_svg(room(), options), HasSubstr("to scale"));
}

TEST(Drawing, ChoosesAReadableEllipseScale) {
  Drawing drawing = room();
  const auto scale = [&](double semi_major) {
    drawing.corners.front().semi_major = semi_major;
    return readable_ellipse_scale(drawing, 100.0);
  };
  EXPECT_EQ(scale(1.0), 1.0);
  EXPECT_EQ(scale(0.18), 1.0);
  EXPECT_EQ(scale(0.018), 10.0);
  EXPECT_EQ(scale(0.008), 20.0);
  EXPECT_EQ(scale(0.0018), 100.0);
  EXPECT_EQ(scale(0.0), 1.0);
  drawing.corners.clear();
  EXPECT_EQ(readable_ellipse_scale(drawing, 100.0), 1.0);
}

TEST(Drawing, OfNothingIsAPictureToo) {
  const std::string svg = draw_svg({});
  expect_well_formed(svg);
  EXPECT_THAT(svg, HasSubstr("0 points"));
}

TEST(Drawing, LeavesOutWhatIsNotFinite) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  Drawing drawing = room();
  drawing.points.push_back({nan, 1.0});
  drawing.points.push_back({1.0, -infinity});
  drawing.lines.push_back({{0.0, nan}, {1.0, 1.0}});
  drawing.corners.push_back({{1.0, 1.0}, infinity, 0.1, 0.0});
  expect_well_formed(draw_svg(drawing));
}

TEST(Drawing, AFarCornerDoesNotShrinkTheRoom) {
  Drawing drawing = room();
  drawing.corners.push_back({{4000.0, 3.0}, 0.01, 0.01, 0.0});
  const std::string svg = draw_svg(drawing);
  EXPECT_THAT(svg, HasSubstr("(1 outside the picture)"));
  EXPECT_DOUBLE_EQ(points_of(svg).at(0).x, points_of(draw_svg(room())).at(0).x);
}

TEST(Drawing, TellsSetsOfEllipsesApartAndMakesRoomForThem) {
  Drawing drawing = room();
  drawing.series = {"wctls", "utls"};
  drawing.ellipses = "one-sigma ellipses";
  drawing.corners.push_back({{4.0, 3.0}, 0.1, 0.1, 0.0, 1});
  DrawingOptions options;
  options.ellipse_scale = 10.0;
  const std::string svg = draw_svg(drawing, options);
  expect_well_formed(svg);
  EXPECT_THAT(svg, HasSubstr("1 corners with one-sigma ellipses, enlarged 10 times"));
  EXPECT_THAT(svg, HasSubstr(">utls<"));
  const auto large = svg_elements(svg, "uncertainty s1");
  ASSERT_EQ(large.size(), 2U);  // the second is in the legend
  // Enlarged to a radius of 1 m above and to the right of the room, below the captions.
  EXPECT_GT(large[0].number("cy") - large[0].number("ry"), 60.0);
  EXPECT_LT(large[0].number("cx") + large[0].number("rx"), options.width);
}

TEST(Drawing, OfAnyExtentHasReadableGrid) {
  for (const double extent : {0.3, 1.0, 7.0, 40.0, 500.0, 20000.0}) {
    Drawing drawing;
    drawing.points = {{extent, 0.0}, {-extent, extent}, {0.0, -extent}};
    const std::string svg = draw_svg(drawing);
    const auto lines = svg_elements(svg, "minor");
    EXPECT_GE(lines.size(), 4U) << extent;
    EXPECT_LE(lines.size(), 50U) << extent;
  }
}

}  // namespace
}  // namespace quoin::deploy
