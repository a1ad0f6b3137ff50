// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/deskewing/scan_motion.hpp"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace quoin {
namespace {

/// Of a sensor that drives at 1 m/s towards a wall 5 m away and looks straight at it, ray by ray.
msg::Scan towards_a_wall(bool with_offsets) {
  msg::Scan scan;
  scan.header().stamp(1'000'000'000);
  for (int i = 0; i <= 10; ++i) {
    scan.bearings().push_back(0.0F);
    scan.ranges().push_back(5.0F - 0.01F * static_cast<float>(i));
    if (with_offsets) scan.time_offsets().push_back(0.01F * static_cast<float>(i));
  }
  return scan;
}

std::vector<msg::Odometry> drive(std::int64_t first, std::int64_t last, std::int64_t step) {
  std::vector<msg::Odometry> messages;
  for (std::int64_t stamp = first; stamp <= last; stamp += step) {
    msg::Odometry& message = messages.emplace_back();
    message.header().stamp(stamp);
    message.pose().x(static_cast<double>(stamp) * 1e-9);
  }
  return messages;
}

std::vector<const msg::Odometry*> pointers(const std::vector<msg::Odometry>& messages) {
  std::vector<const msg::Odometry*> result;
  for (const msg::Odometry& message : messages) result.push_back(&message);
  return result;
}

class MotionOfAScan : public testing::TestWithParam<bool> {};

TEST_P(MotionOfAScan, IsRemovedWithOdometry) {
  msg::Scan scan = towards_a_wall(GetParam());
  DeskewingParameters parameters;
  parameters.sweep = 0.1;
  EXPECT_NEAR(static_cast<double>(last_ray(scan, 0.1)), 1.1e9, 100.0) << "offsets are floats";
  const auto odometry = drive(990'000'000, 1'110'000'000, 30'000'000);
  ASSERT_TRUE(ScanMotion(parameters).remove<msg::Odometry>(pointers(odometry), scan));
  for (const float range : scan.ranges()) EXPECT_NEAR(range, 5.0F, 1e-5F);
  EXPECT_TRUE(scan.time_offsets().empty()) << "all rays are of the first one's time now";
  EXPECT_EQ(scan.duration(), 0.0F);
}

INSTANTIATE_TEST_SUITE_P(WithAndWithoutTimes, MotionOfAScan, testing::Bool());

TEST(ScanMotion, LeavesAScanThatOdometryDoesNotCover) {
  msg::Scan scan = towards_a_wall(true);
  const msg::Scan before = scan;
  const auto odometry = drive(990'000'000, 1'090'000'000, 10'000'000);
  EXPECT_FALSE(ScanMotion({}).remove<msg::Odometry>(pointers(odometry), scan));
  EXPECT_FALSE(ScanMotion({}).remove<msg::Odometry>({}, scan));
  EXPECT_EQ(scan, before);
}

TEST(ScanMotion, RefusesPosesThatAreNone) {
  msg::Scan scan = towards_a_wall(true);
  auto odometry = drive(900'000'000, 1'200'000'000, 100'000'000);
  odometry[1].pose().y(std::nan(""));
  EXPECT_FALSE(ScanMotion({}).remove<msg::Odometry>(pointers(odometry), scan));
}

}  // namespace
}  // namespace quoin
