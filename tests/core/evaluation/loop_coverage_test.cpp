// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/evaluation/loop_coverage.hpp"

#include <gtest/gtest.h>

#include "core/corners/corner_finders.hpp"
#include "core/fitting/fitters.hpp"
#include "core/segmentation/segmenters.hpp"

namespace quoin {
namespace {

LoopCoverage judge(const Fitter& fitter, std::size_t scans) {
  Extraction extraction(Segmenters::make<Segmenter>("iepf", {}), fitter,
                        CornerFinders::make<CornerFinder>("adjacent", {}));
  return judge_loop(extraction, built_in_world("square_room").value(), SensorModel{}, scans, 3);
}

TEST(LoopCoverage, IsNearNinetyFivePercentForTrueCovariances) {
  const LoopCoverage loop = judge(Fitters::make<Fitter>("wctls", {}), 300);
  EXPECT_EQ(loop.scans, 300U);
  EXPECT_NEAR(loop.segments_per_scan, 4.0, 0.05);
  EXPECT_NEAR(loop.corners_per_scan, 4.0, 0.05);
  // 1200 corners: 0.6 % of standard error, and what the segmentation costs.
  EXPECT_NEAR(loop.coverage95.value, 0.95, 0.025);
  EXPECT_LT(loop.coverage95.low, loop.coverage95.value);
  EXPECT_GT(loop.coverage95.high, loop.coverage95.value);
  EXPECT_LT(loop.coverage95.high - loop.coverage95.low, 0.04);
  EXPECT_NEAR(loop.nees.value, 2.0, 0.25);
  EXPECT_LT(loop.beyond_four_sigma, 0.01);
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
  EXPECT_NEAR(loop.coverage95.value, 0.527, 0.08);
  EXPECT_EQ(loop.failures[static_cast<std::size_t>(FitFailure::degenerate)],
            static_cast<std::size_t>(calls) / 4U);
  EXPECT_EQ(loop.failures[static_cast<std::size_t>(FitFailure::none)],
            static_cast<std::size_t>(calls - calls / 4));
}

TEST(LoopCoverage, OfNoScansIsNothing) {
  const LoopCoverage loop = judge(Fitters::make<Fitter>("wctls", {}), 0);
  EXPECT_EQ(loop.scans, 0U);
  EXPECT_EQ(loop.corners_per_scan, 0.0);
  EXPECT_EQ(loop.coverage95.value, 0.0);
}

}  // namespace
}  // namespace quoin
