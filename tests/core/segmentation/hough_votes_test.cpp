// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/segmentation/hough_votes.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "core/geometry/angle.hpp"
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

}  // namespace
}  // namespace quoin
