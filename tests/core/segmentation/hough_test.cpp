// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/segmentation/hough.hpp"

#include <cmath>

#include <gmock/gmock.h>

#include "core/geometry/angle.hpp"
#include "tests/core/segmentation/segmenter_scans.hpp"
#include "tests/core/wall_points.hpp"

namespace quoin {
namespace {

/// How far the middle of the peak's cell is from a line, at most, over the points.
double largest_distance(const NormalLine& line, const Points& points) {
  double largest = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    largest = std::max(
        largest, std::abs(line.normal_x * points.x[i] + line.normal_y * points.y[i] - line.offset));
  }
  return largest;
}

TEST(HoughVotes, PeakAtTheLineOfTheirPoints) {
  const double angle = 0.02;
  const double offset = 0.05;
  HoughVotes votes(angle, offset);
  for (int k = 0; k < 40; ++k) {
    const double alpha = 0.16 * k;
    const Points points = exact_wall_points({alpha, 2.0}, alpha - 0.3, alpha + 0.5, 50);
    votes.start(points, {0, 50});
    const HoughVotes::Peak peak = votes.peak();
    // Half a cell of direction moves the ends of the wall, about 0.9 m from its middle, by less
    // than a cell of distance, so that at most two cells share the points.
    EXPECT_GE(peak.votes, 25) << alpha;
    EXPECT_LE(peak.votes, 50) << alpha;
    EXPECT_LE(largest_distance(peak.line, points), 0.9 * angle + offset) << alpha;
  }
}

TEST(HoughVotes, AreTakenBackOnce) {
  HoughVotes votes(0.03, 0.05);
  const Points points = exact_wall_points({0.4, 2.0}, 0.0, 0.8, 60);
  votes.start(points, {10, 50});
  EXPECT_GE(votes.peak().votes, 20);
  votes.take_back(points, {10, 40});
  EXPECT_EQ(votes.peak().votes, 10);  // all the rest on one line
  votes.take_back(points, {30, 50});
  EXPECT_EQ(votes.peak().votes, 0);
  votes.start(points, {0, 5});
  EXPECT_EQ(votes.peak().votes, 5);
}

TEST(HoughVotes, PassOverADiscardedCell) {
  HoughVotes votes(0.03, 0.05);
  const Points points = exact_wall_points({0.4, 2.0}, 0.0, 0.8, 60);
  votes.start(points, {0, 60});
  const HoughVotes::Peak first = votes.peak();
  votes.discard(first.cell);
  const HoughVotes::Peak second = votes.peak();
  EXPECT_NE(second.cell, first.cell);
  EXPECT_LE(second.votes, first.votes);
  votes.start(points, {0, 60});
  EXPECT_EQ(votes.peak().cell, first.cell);
}

TEST(HoughVotes, DivideALargeHallMoreCoarsely) {
  HoughVotes votes(0.1, 0.002);
  const Points points = exact_wall_points({0.0, 1.0}, -1.57, 1.57, 101);  // 2.5 km
  votes.start(points, {0, 101});
  const HoughVotes::Peak peak = votes.peak();
  EXPECT_EQ(peak.votes, 101);
  EXPECT_LE(largest_distance(peak.line, points),
            2.0 * 1256.0 * 1.42 / (HoughVotes::most_offsets - 1.0));
}

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
