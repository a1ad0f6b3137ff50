// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/mapping/landmarks.hpp"

#include <cmath>
#include <functional>

#include <gtest/gtest.h>

#include "core/corners/corner_finders.hpp"
#include "core/evaluation/mapping_quality.hpp"
#include "core/fitting/fitters.hpp"
#include "core/mapping/angular_offsets.hpp"
#include "core/segmentation/segmenters.hpp"
#include "core/simulation/scanner.hpp"
#include "core/statistics/order_statistics.hpp"

namespace quoin {
namespace {

Extraction extraction() {
  return {Segmenters::make<Segmenter>("iepf", {}), Fitters::make<Fitter>("inverse_range", {}),
          CornerFinders::make<CornerFinder>("adjacent", {})};
}

class LandmarksInARoom : public testing::TestWithParam<bool> {};

TEST_P(LandmarksInARoom, StayTrueOverLaps) {
  SimulatedDrive drive;
  drive.laps = 3.0;
  drive.rays = 360;
  drive.heading_bias = 0.002;
  drive.odometry = GetParam();
  Extraction lines = extraction();
  const MappingQuality quality =
      judge_localizer(Landmarks{}, lines, built_in_world("domestic_room").value(), drive);
  EXPECT_LT(median(quality.translation_errors), 0.02);
  EXPECT_LT(quantile(quality.heading_errors, 1.0), 0.01);
  EXPECT_EQ(quality.confident_wrong, 0U);
  EXPECT_GT(quality.tracking, 0.98 * static_cast<double>(quality.scans));
  // Errors of neighbouring scans have the map's in common: a wide interval for few of them.
  EXPECT_GT(quality.mean_nees(), 1.5);
  EXPECT_LT(quality.mean_nees(), 4.5);
  EXPECT_GT(quality.coverage95(), 0.88);
  EXPECT_GT(quality.map_precision, 0.95);
  EXPECT_GT(quality.map_recall, 0.7);
}

INSTANTIATE_TEST_SUITE_P(WithAndWithoutOdometry, LandmarksInARoom, testing::Bool());

TEST(AngularOffsetsInARoom, KeepTheirHeadingOverLaps) {
  SimulatedDrive drive;
  drive.laps = 10.0;
  drive.rays = 360;
  drive.heading_bias = 0.01;  // 0.5 rad over the way
  Extraction lines = extraction();
  const MappingQuality quality =
      judge_localizer(AngularOffsets{}, lines, built_in_world("square_room").value(), drive);
  const std::size_t tenth = quality.scans / 10;
  const double last = median(
      {quality.heading_errors.end() - static_cast<long>(tenth), quality.heading_errors.end()});
  EXPECT_LT(last, 0.005);
}

/// The scan of a world from a pose, as lines.
class Robot {
 public:
  explicit Robot(World world) : world_(std::move(world)) {}

  const Localization& see(const Pose2& pose, const std::optional<PoseEstimate>& motion) {
    world_.path = {pose};
    ScannerSettings settings;
    settings.points = 360;
    SimulatedScanner scanner(world_, settings, ++seed_);
    scanner.scan(0.0, 0.0, scan_);
    extraction_.run(view(scan_, settings), settings.noise, settings.noise);
    LocalizationInput input;
    input.stamp = 0.1 * static_cast<double>(seed_);
    input.lines = extraction_.lines();
    input.corners = extraction_.corners();
    input.motion = motion;
    localizer_(input, result_);
    return result_;
  }

 private:
  World world_;
  Extraction extraction_ = extraction();
  Landmarks localizer_;
  Localization result_;
  SimulatedScan scan_;
  std::uint64_t seed_ = 0;
};

PoseEstimate driven(double ahead) {
  const Pose2 increment{ahead, 0.0, 0.0};
  return {increment, OdometryNoise{}.covariance(increment)};
}

TEST(Landmarks, SayThatACorridorWithoutEndsLeavesADirectionOpen) {
  World world;
  world.walls = {{{-200.0, -1.0}, {200.0, -1.0}}, {{200.0, 1.0}, {-200.0, 1.0}}};
  Robot robot(world);
  for (int i = 0; i < 30; ++i) {
    const Localization& result =
        robot.see({0.1 * i, 0.0, 0.0}, i == 0 ? std::nullopt : std::optional(driven(0.1)));
    if (i == 0) continue;
    EXPECT_EQ(result.status, LocalizationStatus::ambiguous);
    ASSERT_TRUE(result.weak_direction);
    EXPECT_NEAR(std::sin(*result.weak_direction), 0.0, 0.02);  // along x
    if (i == 29) {
      // The odometry alone: 2 % of slip over 2.9 m, less where it is taken as independent.
      EXPECT_GT(std::sqrt(result.pose.covariance(0, 0)), 0.01);
      EXPECT_LT(std::sqrt(result.pose.covariance(1, 1)), 0.01);
    }
  }
}

TEST(Landmarks, AreLostWhereTheRobotIsPutElsewhereAndFindItAgain) {
  World world = built_in_world("environment_b").value();
  Robot robot(world);
  Pose2 pose{8.0, 4.0, 0.0};
  const Pose2 origin = pose;
  for (int i = 0; i < 40; ++i) {
    robot.see(pose, i == 0 ? std::nullopt : std::optional(driven(0.1)));
    pose.x += 0.1;
  }
  pose = {5.5, 6.8, 1.0};  // carried, while the wheels stood still
  int lost_after = -1, found_after = -1;
  for (int i = 0; i < 60 && found_after < 0; ++i) {
    const Localization& result = robot.see(pose, driven(0.0));
    const Pose2 truth = between(origin, pose);
    const double error = std::hypot(result.pose.pose.x - truth.x, result.pose.pose.y - truth.y);
    if (result.status == LocalizationStatus::tracking) {
      EXPECT_LT(error, 0.1) << "confident and wrong after " << i;
      found_after = i;
    }
    if (result.status == LocalizationStatus::lost && lost_after < 0) lost_after = i;
  }
  EXPECT_GE(lost_after, 0);
  EXPECT_LE(lost_after, 10);  // a second
  EXPECT_GE(found_after, 0);
}

}  // namespace
}  // namespace quoin
