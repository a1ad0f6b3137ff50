// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/segmentation/line_regression.hpp"

#include <cmath>

#include <gmock/gmock.h>

#include "tests/core/segmentation/segmenter_scans.hpp"
#include "tests/core/wall_points.hpp"

namespace quoin {
namespace {

LineRegression::Parameters bare() {
  LineRegression::Parameters parameters;
  parameters.merge = false;
  parameters.refine = false;
  return parameters;
}

TEST(LineRegression, EndsASegmentWhereTheWindowsDifferMost) {
  for (const Eigen::Vector2d& corner : {Eigen::Vector2d(2.0, 2.0), Eigen::Vector2d(1.4, 0.4)}) {
    const Points points =
        polyline_points({{corner.x(), -1.0}, corner, {corner.x() - 2.0, corner.y() + 0.6}});
    const auto segments = segments_by<LineRegression>(points, bare());
    ASSERT_EQ(segments.size(), 2U);
    EXPECT_EQ(segments[0].end, segments[1].begin);
    // The vertex itself is on both.
    EXPECT_NEAR(static_cast<double>(segments[0].end),
                static_cast<double>(nearest_point(points, corner)), 1.0);
  }
}

TEST(LineRegression, RarelyTakesNoiseForAChange) {
  // The tolerance is above 4 standard deviations for most points, so that the distance is at most
  // chi square with two degrees of freedom: above 12 with a probability of 0.25 %. That is 4 of
  // 30 x 60 points if they were independent; neighbours are not, and only peaks count.
  std::mt19937_64 engine(7);
  std::size_t pieces = 0;
  for (int k = 0; k < 30; ++k) {
    const Points points = wall_points({0.0, 2.0}, -0.2, 0.2, 60, SensorModel{}, engine);
    pieces += segments_by<LineRegression>(points, bare()).size();
  }
  EXPECT_LE(pieces, 30U + 8U);
}

TEST(LineRegression, TellsLinesApartByTheLimit) {
  const Points points = polyline_points({{2.0, -1.0}, {2.0, 0.0}, {1.5, 0.87}});  // 30 deg
  EXPECT_EQ(segments_by<LineRegression>(points, bare()).size(), 2U);
  auto parameters = bare();
  parameters.change = 1000.0;
  parameters.split_distance = 0.5;
  parameters.max_bend = 1.0;
  EXPECT_EQ(segments_by<LineRegression>(points, parameters).size(), 1U);
}

TEST(LineRegression, TakesAPieceApartThatIsNotStraight) {
  const Eigen::Vector2d corner(2.0, 2.0);
  const Points points = polyline_points({{2.0, -1.0}, corner, {-1.0, 2.0}});
  LineRegression::Parameters parameters;
  parameters.change = 10000.0;  // no window sees the corner
  const auto segments = long_ones(segments_by<LineRegression>(points, parameters), 100);
  ASSERT_EQ(segments.size(), 2U);
  const double vertex = static_cast<double>(nearest_point(points, corner));
  EXPECT_LE(static_cast<double>(segments[0].end), vertex + 3.0);
  EXPECT_GE(static_cast<double>(segments[1].begin), vertex - 3.0);
}

}  // namespace
}  // namespace quoin
