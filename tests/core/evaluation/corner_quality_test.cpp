// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/evaluation/corner_quality.hpp"

#include <algorithm>

#include <gtest/gtest.h>

#include "core/corners/corner_finders.hpp"
#include "core/fitting/likelihood_fitters.hpp"
#include "core/segmentation/segmenters.hpp"

namespace quoin {
namespace {

Extraction extraction(const ParameterSettings& segmenter = {}) {
  return {Segmenters::make<Segmenter>("iepf", segmenter), InverseRange(),
          CornerFinders::make<CornerFinder>("adjacent", {})};
}

Corner corner_at(double x, double y, double sigma = 0.01) {
  Corner corner;
  corner.estimate = {{x, y}, sigma * sigma * Eigen::Matrix2d::Identity()};
  return corner;
}

TEST(CornerTruth, AsksForWallsThatAreSeenUpToTheCorner) {
  // From (1, 1) a screen leaves 0.2 m of the wall x = 4 before the corner (4, 3).
  const Pose2 pose{1, 1, 0.5};
  World world;
  world.add_polyline({{0, 0}, {4, 0}, {4, 3}, {0, 3}}, true);
  world.add_polyline({{3, 2.2}, {3.2, 1.9}}, false);
  const CornerTruth truth = corner_truth(world, pose, 920);
  ASSERT_EQ(truth.positions.size(), 4U);
  EXPECT_EQ(std::ranges::count(truth.to_be_found, true), 3);
  for (std::size_t k = 0; k < 4; ++k) {
    if (truth.to_be_found[k]) continue;
    EXPECT_NEAR((truth.positions[k] - pose.inverse_transform({4, 3})).norm(), 0.0, 1e-12);
  }
  // Where 0.1 m and 4 points will do, it is to be found, too.
  EXPECT_EQ(std::ranges::count(corner_truth(world, pose, 920, {4, 0.1}).to_be_found, true), 4);
  // With 16 rays no wall has eight points.
  EXPECT_EQ(std::ranges::count(corner_truth(world, pose, 16).to_be_found, true), 0);
}

TEST(CornerTally, SetsFalseCornersApartFromCoverage) {
  const CornerTruth truth{{{1, 0}, {0, 2}, {5, 5}}, {true, true, false}};
  CornerTally tally;
  tally.begin_world();
  // Within 95 %, beyond four sigma, near no true corner, and the second of the same true corner.
  tally.add({corner_at(1.01, 0), corner_at(0, 2.05), corner_at(3, 3), corner_at(1.02, 0)}, truth);
  // A corner that need not be found counts when it is.
  tally.add({corner_at(5.025, 5)}, truth);
  const CornerQuality quality = tally.quality();
  EXPECT_EQ(quality.scans, 2U);
  EXPECT_EQ(quality.true_corners, 4U);
  EXPECT_EQ(quality.found_corners, 5U);
  EXPECT_EQ(quality.false_corners, 2U);
  EXPECT_DOUBLE_EQ(quality.recall.value, 0.5);
  EXPECT_DOUBLE_EQ(quality.precision.value, 0.6);
  EXPECT_DOUBLE_EQ(quality.coverage.value, 1.0 / 3.0);
  EXPECT_DOUBLE_EQ(quality.beyond_four_sigma, 1.0 / 3.0);
  EXPECT_NEAR(quality.nees.value, 0.5 * (1.0 + 6.25), 1e-9);
  ASSERT_EQ(quality.corners.size(), 3U);
  EXPECT_EQ(quality.corners[0].covered, 1U);
  EXPECT_EQ(quality.corners[1].beyond_four_sigma, 1U);
  EXPECT_EQ(quality.corners[2].observations, 1U);
  EXPECT_EQ(quality.corners[2].covered, 0U);
}

TEST(CornerQuality, CountsTheCornersOfARoom) {
  Extraction good = extraction();
  const CornerQuality quality = judge_room_corners(good, {360, {}, 0.0, 100, 3, 0.0});
  EXPECT_EQ(quality.scans, 100U);
  EXPECT_EQ(quality.true_corners, 400U);
  EXPECT_GE(quality.recall.value, 0.97);
  EXPECT_EQ(quality.false_corners, 0U);
  EXPECT_GT(quality.coverage.value, 0.90);  // 5 standard deviations
  EXPECT_NEAR(quality.nees.value, 2.0, 0.5);
}

TEST(CornerQuality, SeesWhatStraysDoToASegmenterThatKnowsNone) {
  Extraction good = extraction();
  Extraction plain = extraction({{"max_line_gap", "0"}, {"merge", "false"}, {"refine", "false"}});
  const DisturbedScans strays{360, {}, 0.1, 50, 3, 0.0};
  EXPECT_LT(judge_room_corners(plain, strays).recall.value,
            judge_room_corners(good, strays).recall.value);
}

TEST(CornerQuality, AColumnHasFalseCornersOnly) {
  Extraction plain = extraction({{"merge", "false"}, {"max_bend", "1"}});
  const CornerQuality quality = judge_column(plain, 0.45, 2.0, {920, {}, 0.0, 50, 3, 0.0});
  EXPECT_EQ(quality.true_corners, 0U);
  EXPECT_GT(quality.false_per_100_scans(), 10.0);
  Extraction good = extraction();
  EXPECT_LE(judge_column(good, 0.45, 2.0, {920, {}, 0.0, 50, 3, 0.0}).false_per_100_scans(), 2.0);
}

}  // namespace
}  // namespace quoin
