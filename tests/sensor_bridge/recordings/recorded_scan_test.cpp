// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "sensor_bridge/recordings/recorded_scan.hpp"

#include <cmath>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace quoin::sensor_bridge {
namespace {

using ::testing::ElementsAre;
using ::testing::NanSensitiveFloatEq;

constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr float nan = std::numeric_limits<float>::quiet_NaN();

TEST(RangeLimits, AreMarkedByRep117) {
  std::vector<float> ranges{0.05F, 0.1F,  79.99F, 80.0F,    81.91F,
                            0.0F,  -1.0F, nan,    infinity, -infinity};
  apply_range_limits(0.1, 80.0, ranges);
  EXPECT_THAT(ranges,
              ElementsAre(-infinity, 0.1F, 79.99F, infinity, infinity, NanSensitiveFloatEq(nan),
                          NanSensitiveFloatEq(nan), NanSensitiveFloatEq(nan), infinity, -infinity));
}

TEST(RecordedScan, IsEmptyWhenClearedAndKeepsItsMemory) {
  RecordedScan scan;
  scan.stamp = 1.0;
  scan.ranges.assign(100, 1.0F);
  scan.bearings.assign(100, 1.0F);
  scan.pose = Pose2{};
  scan.odometry.emplace_back();
  scan.first_of_file = true;
  const float* memory = scan.ranges.data();
  scan.clear();
  EXPECT_TRUE(scan.ranges.empty() && scan.bearings.empty());
  EXPECT_FALSE(scan.stamp || scan.pose || !scan.odometry.empty() || scan.first_of_file);
  scan.ranges.resize(100);
  EXPECT_EQ(scan.ranges.data(), memory);
}

}  // namespace
}  // namespace quoin::sensor_bridge
