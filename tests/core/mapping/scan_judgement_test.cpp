// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/mapping/scan_judgement.hpp"

#include <array>

#include <gtest/gtest.h>

namespace quoin {
namespace {

/// A wall of 2 m across the x axis at this distance, seen from the origin.
LineMeasurement across(double distance) {
  LineMeasurement m;
  m.middle = {distance, 0.0};
  m.half_length = 1.0;
  m.covariance = 1e-4 * Eigen::Matrix2d::Identity();
  return m;
}

TEST(SeenThrough, CountsWallsBeforeWhatIsSeen) {
  LineLandmark near = landmark_of({}, across(2.0));
  near.low = -0.5;
  near.high = 0.5;
  near.observations = 3;
  const std::array<LineLandmark, 1> map{near};
  const std::array<std::size_t, 1> walls{0};
  const std::array<LineMeasurement, 1> behind{across(4.0)};
  const std::array<LineMeasurement, 1> at{across(2.0)};
  EXPECT_DOUBLE_EQ(seen_through({}, map, walls, behind), 1.0);
  EXPECT_DOUBLE_EQ(seen_through({}, map, walls, at), 0.0);
  EXPECT_DOUBLE_EQ(seen_through({3.0, 0.0, 0.0}, map, walls, behind), 0.0);  // behind the robot
}

TEST(Judge, NamesTheDirectionThatOneWallLeavesOpen) {
  const std::array<LineLandmark, 1> map{landmark_of({}, across(2.0))};
  const std::array<LineMeasurement, 1> scan{across(2.0)};
  WallBelief belief;
  belief.landmarks = {0};
  belief.walls = {{map[0].phi, map[0].offset}};
  belief.covariance = 1e-4 * Eigen::MatrixXd::Identity(5, 5);
  const WallPairs pairs{{0, 0}};
  const ScanJudgement judged = judge({map, scan, belief, pairs, 1.0, 1.0, 100, {}, true});
  EXPECT_TRUE(judged.fits);
  EXPECT_EQ(judged.status, LocalizationStatus::ambiguous);
  ASSERT_TRUE(judged.weak_direction);
  EXPECT_NEAR(std::cos(*judged.weak_direction), 0.0, 1e-9);  // along y
}

TEST(LossMonitor, IsLostAfterScansAndTimeAndFoundByScansThatFitWell) {
  LossMonitor monitor;
  monitor.add_fit(1.0, true);
  EXPECT_FALSE(monitor.add_misfit(1.1));
  EXPECT_FALSE(monitor.add_misfit(1.2));
  EXPECT_FALSE(monitor.add_misfit(1.3));  // three scans, but within 0.6 s
  EXPECT_TRUE(monitor.add_misfit(1.7));
  EXPECT_TRUE(monitor.is_lost());
  EXPECT_FALSE(monitor.add_misfit(1.8));  // was lost before
  for (int i = 0; i < 4; ++i) monitor.add_fit(2.0 + 0.1 * i, true);
  monitor.add_fit(2.5, false);
  for (int i = 0; i < 4; ++i) monitor.add_fit(3.0 + 0.1 * i, true);
  EXPECT_TRUE(monitor.is_lost());
  monitor.add_fit(3.5, true);
  EXPECT_FALSE(monitor.is_lost());
}

}  // namespace
}  // namespace quoin
