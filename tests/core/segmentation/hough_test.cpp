// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/segmentation/hough.hpp"

#include <cmath>

#include <gmock/gmock.h>

#include "tests/core/segmentation/segmenter_scans.hpp"
#include "tests/core/wall_points.hpp"

namespace quoin {
namespace {

Hough::Parameters bare() {
  Hough::Parameters parameters;
  parameters.merge = false;
  parameters.refine = false;
  return parameters;
}

/// A wall at 2 m with a flat box before it that hides points [40, 60).
Points wall_behind_a_box(double depth) {
  std::vector<double> bearings;
  std::vector<double> ranges;
  for (int i = 0; i < 100; ++i) {
    bearings.push_back(-0.5 + 0.01 * i);
    ranges.push_back((i >= 40 && i < 60 ? 2.0 - depth : 2.0) / std::cos(bearings.back()));
  }
  return points_from(bearings, ranges);
}

TEST(Hough, TakesBothPartsOfAWallByTurns) {
  // All 80 points of the wall vote for one line, but a segment is a run.
  auto parameters = bare();
  parameters.breakpoint_angle = 0.02;  // the box belongs to the cluster
  EXPECT_THAT(segments_by<Hough>(wall_behind_a_box(0.12), parameters),
              testing::ElementsAre(Segment{0, 40}, Segment{40, 60}, Segment{60, 100}));
}

TEST(Hough, WorksWithAnySensibleResolution) {
  const Points points = noisy_points("square_room", 4);
  for (const double degrees : {0.5, 2.0, 5.0}) {
    for (const double offset : {0.01, 0.04, 0.1}) {
      auto parameters = bare();
      parameters.angle_resolution = degrees / 57.3;
      parameters.offset_resolution = offset;
      EXPECT_EQ(long_ones(segments_by<Hough>(points, parameters), 190).size(), 4U)
          << degrees << " deg, " << offset << " m";
    }
  }
}

TEST(Hough, TakesTheLongestWallFirst) {
  // Both walls may have the points within 5 cm of the corner: the longer one gets them.
  const Eigen::Vector2d corner(2.0, 1.0);
  for (const double sign : {1.0, -1.0}) {
    const Points points =
        polyline_points(sign > 0.0 ? std::vector<Eigen::Vector2d>{{2.0, -2.0}, corner, {1.2, 1.0}}
                                   : std::vector<Eigen::Vector2d>{{2.0, 0.6}, corner, {-2.0, 1.0}});
    const auto segments = segments_by<Hough>(points, bare());
    ASSERT_EQ(segments.size(), 2U);
    const double vertex = static_cast<double>(nearest_point(points, corner));
    EXPECT_GE(sign * (static_cast<double>(segments[0].end) - vertex), 0.0);
  }
}

TEST(Hough, EndsWithClutter) {
  std::mt19937_64 engine(3);
  std::normal_distribution<double> normal(0.0, 0.15);
  std::vector<double> bearings;
  std::vector<double> ranges;
  for (int i = 0; i < 600; ++i) {
    bearings.push_back(-0.9 + 0.003 * i);
    ranges.push_back(2.0 + normal(engine));
  }
  auto parameters = bare();
  parameters.breakpoint_angle = 0.0031;
  parameters.split_distance = 0.01;
  parameters.min_points = 20;  // 1 cm on either side of a ray are 4 points, a cell of 4 cm is 7
  EXPECT_TRUE(
      segments_by<Hough>(points_from(bearings, ranges), parameters, {0.15, 0.0, 0.0}).size() < 60U);
  EXPECT_TRUE(
      segments_by<Hough>(points_from(bearings, ranges), parameters, {0.0, 0.0, 0.0}).empty());
}

}  // namespace
}  // namespace quoin
