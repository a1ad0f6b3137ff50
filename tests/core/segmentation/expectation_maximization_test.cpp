// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/segmentation/expectation_maximization.hpp"

#include <cmath>

#include <gmock/gmock.h>

#include "tests/core/segmentation/segmenter_scans.hpp"
#include "tests/core/wall_points.hpp"

namespace quoin {
namespace {

ExpectationMaximization::Parameters bare() {
  ExpectationMaximization::Parameters parameters;
  parameters.merge = false;
  parameters.refine = false;
  return parameters;
}

TEST(ExpectationMaximization, NeedsNoMergingForARoom) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const auto segments =
        segments_by<ExpectationMaximization>(noisy_points("square_room", seed), bare());
    EXPECT_EQ(long_ones(segments, 200).size(), 4U) << seed;
  }
}

TEST(ExpectationMaximization, GivesTheRunsOfALineOneByOne) {
  // A box of 12 cm before a wall; both sides of the wall are explained by one line.
  std::vector<double> bearings;
  std::vector<double> ranges;
  for (int i = 0; i < 120; ++i) {
    bearings.push_back(-0.6 + 0.01 * i);
    ranges.push_back((i >= 48 && i < 72 ? 1.88 : 2.0) / std::cos(bearings.back()));
  }
  auto parameters = bare();
  parameters.breakpoint_angle = 0.02;
  EXPECT_THAT(segments_by<ExpectationMaximization>(points_from(bearings, ranges), parameters),
              testing::ElementsAre(Segment{0, 48}, Segment{48, 72}, Segment{72, 120}));
}

TEST(ExpectationMaximization, ConvergesToTheWallsFromLargerWindows) {
  const Points points = noisy_points("square_room", 6);
  auto parameters = bare();
  parameters.lines = 12;  // windows of 77 points
  EXPECT_EQ(long_ones(segments_by<ExpectationMaximization>(points, parameters), 200).size(), 4U);
  parameters.lines = 1;  // one line through a room is not straight: nothing to start from
  EXPECT_TRUE(segments_by<ExpectationMaximization>(points, parameters).empty());
}

}  // namespace
}  // namespace quoin
