// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/evaluation/loop_coverage.hpp"

#include <algorithm>
#include <vector>

#include <gtest/gtest.h>

#include "core/corners/corner_finders.hpp"
#include "core/fitting/fitters.hpp"
#include "core/segmentation/segmenters.hpp"

namespace quoin {
namespace {

LoopCoverage judge(const Fitter& fitter, std::size_t scans) {
  Extraction extraction(Segmenters::make<Segmenter>("iepf", {}), fitter,
                        CornerFinders::make<CornerFinder>("adjacent", {}));
  const World world = built_in_world("square_room").value();
  return judge_loop(extraction, {&world, 1}, {.scans = scans, .seed = 3});
}

TEST(LoopCoverage, IsNearNinetyFivePercentForTrueCovariances) {
  const LoopCoverage loop = judge(Fitters::make<Fitter>("wctls", {}), 300);
  EXPECT_EQ(loop.scans, 300U);
  EXPECT_NEAR(loop.segments_per_scan, 4.0, 0.05);
  EXPECT_NEAR(loop.corners_per_scan, 4.0, 0.05);
  // 1200 corners: 0.6 % of standard error, and what the segmentation costs.
  EXPECT_NEAR(loop.corners.coverage.value, 0.95, 0.025);
  EXPECT_LT(loop.corners.coverage.low, loop.corners.coverage.value);
  EXPECT_GT(loop.corners.coverage.high, loop.corners.coverage.value);
  EXPECT_LT(loop.corners.coverage.high - loop.corners.coverage.low, 0.04);
  EXPECT_NEAR(loop.corners.nees.value, 2.0, 0.25);
  EXPECT_LT(loop.corners.beyond_four_sigma, 0.01);
}

TEST(LoopCoverage, SeesCovariancesThatAreTooSmallAndFailures) {
  const Fitter wctls = Fitters::make<Fitter>("wctls", {});
  int calls = 0;
  const Fitter boastful = [&](const PointsView& points, const SensorModel& sensor) {
    if (++calls % 4 == 0) return FitResult::failed(FitFailure::degenerate);
    FitResult result = wctls(points, sensor);
    result.estimate.covariance *= 0.25;
    return result;
  };
  const LoopCoverage loop = judge(boastful, 200);
  // P(chi^2_2 < 5.99 / 4) = 0.527; 600 fits of 800, so at most 2 corners a scan.
  EXPECT_NEAR(loop.corners.coverage.value, 0.527, 0.08);
  EXPECT_EQ(loop.failures[static_cast<std::size_t>(FitFailure::degenerate)],
            static_cast<std::size_t>(calls) / 4U);
  EXPECT_EQ(loop.failures[static_cast<std::size_t>(FitFailure::none)],
            static_cast<std::size_t>(calls - calls / 4));
}

/// A flat of 8 x 6 m whose partitions end on walls: from its first room four corners are seen, two
/// of them T-junctions, from the second five with the free end of a partition, which is none.
World flat(const Pose2& pose) {
  World world;
  world.add_polyline({{0, 0}, {8, 0}, {8, 6}, {0, 6}}, true);
  world.add_polyline({{3, 0}, {3, 2.2}}, false);
  world.add_polyline({{3, 3.2}, {3, 6}}, false);
  world.add_polyline({{3, 4}, {6, 4}}, false);
  world.path = {pose};
  return world;
}

TEST(LoopCoverage, CountsCornersWherePartitionsEndOnWalls) {
  Extraction extraction(Segmenters::make<Segmenter>("iepf", {}),
                        Fitters::make<Fitter>("inverse_range", {}),
                        CornerFinders::make<CornerFinder>("adjacent", {}));
  const std::vector<World> worlds{flat({1.5, 2.7, 0.2}), flat({4.0, 5.0, 1.0})};
  const LoopCoverage loop = judge_loop(extraction, worlds, {.scans = 300, .seed = 3});
  EXPECT_EQ(loop.scans, 600U);
  EXPECT_EQ(loop.corners.true_corners, 300U * (4U + 3U));
  EXPECT_GT(loop.corners.recall.value, 0.99);
  EXPECT_GT(loop.corners.precision.value, 0.999);
  EXPECT_NEAR(loop.corners.coverage.value, 0.95, 0.025);  // 2100 corners, 5 standard deviations
  EXPECT_LT(loop.corners.beyond_four_sigma, 0.005);
  // Both rooms know all seven corners of the flat; four and three of them were seen.
  EXPECT_EQ(loop.corners.corners.size(), 14U);
  EXPECT_EQ(std::ranges::count_if(loop.corners.corners,
                                  [](const auto& corner) { return corner.observations > 250; }),
            7);
  EXPECT_EQ(loop.lines.false_lines, 0U);
  EXPECT_NEAR(loop.lines.coverage.value, 0.95, 0.02);
}

TEST(LoopCoverage, OfLinesSeesCovariancesThatAreTooSmall) {
  const Fitter inverse_range = Fitters::make<Fitter>("inverse_range", {});
  const LoopCoverage loop = judge(
      [&](const PointsView& points, const SensorModel& sensor) {
        FitResult result = inverse_range(points, sensor);
        result.estimate.covariance *= 0.25;
        return result;
      },
      200);
  EXPECT_NEAR(loop.lines.coverage.value, 0.527, 0.08);  // P(chi^2_2 < 5.99 / 4)
}

TEST(LoopCoverage, OfNoScansIsNothing) {
  const LoopCoverage loop = judge(Fitters::make<Fitter>("wctls", {}), 0);
  EXPECT_EQ(loop.scans, 0U);
  EXPECT_EQ(loop.corners_per_scan, 0.0);
  EXPECT_EQ(loop.corners.coverage.value, 0.0);
}

}  // namespace
}  // namespace quoin
