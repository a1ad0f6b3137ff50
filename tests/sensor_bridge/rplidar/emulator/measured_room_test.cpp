// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/sensor_bridge/rplidar/emulator/measured_room.hpp"

#include <gtest/gtest.h>

namespace quoin::sensor_bridge::rplidar {
namespace {

class OfEachFormat : public ::testing::TestWithParam<std::size_t> {
 protected:
  /// 236 revolutions.
  [[nodiscard]] static MeasuredRoom measure(const std::string& faults, double seconds = 23.8) {
    EmulatorSettings settings = without_noise();
    settings.all_formats = true;
    settings.baud_rate = 512000;
    settings.faults = faults;
    return measure_room(settings, GetParam(), {.seconds = seconds, .lateness = 0.002});
  }
};

TEST_P(OfEachFormat, LostFramesCostTheirSamplesAndNoBearings) {
  const MeasuredRoom room = measure("lost_frames=0.02");
  EXPECT_GE(room.revolutions, 235u);
  EXPECT_EQ(room.wrong_points, 0u) << room.worst_point;
  EXPECT_GT(room.lost_samples, 0u);
  // Ultra capsules lean on the one behind with two samples; a node between two lost ones goes with
  // them.
  EXPECT_NEAR(static_cast<double>(room.lost_samples), static_cast<double>(room.affected_samples),
              0.04 * static_cast<double>(room.affected_samples) + 1.0);
  EXPECT_LT(room.worst_stamp, 1e-3);
}

TEST_P(OfEachFormat, RepeatedFramesCostNothing) {
  const MeasuredRoom room = measure("repeated_frames=0.02");
  EXPECT_GE(room.revolutions, 235u);
  EXPECT_EQ(room.wrong_points, 0u) << room.worst_point;
  EXPECT_EQ(room.lost_samples, 0u);
  EXPECT_GT(room.affected_samples, 0u);
}

TEST_P(OfEachFormat, SwappedFramesCostAtMostTheirSamples) {
  const MeasuredRoom room = measure("swapped_frames=0.02");
  EXPECT_GE(room.revolutions, 235u);
  EXPECT_EQ(room.wrong_points, 0u) << room.worst_point;
  EXPECT_LE(room.lost_samples, room.affected_samples + room.affected_samples / 40);
}

TEST_P(OfEachFormat, LostBytesCostNoBearings) {
  const MeasuredRoom room = measure("dropped_bytes=0.0002");
  EXPECT_GE(room.revolutions, 190u);
  // Standard nodes have no checksum: one in a hundred lost bytes leaves what looks like nodes.
  EXPECT_LE(room.wrong_points, GetParam() == 0 ? 2u : 0u) << room.worst_point;
  EXPECT_GT(room.lost_samples, 0u);
}

TEST_P(OfEachFormat, SpeedsThatCannotBeAreNoScans) {
  for (const char* fault : {"speed=25", "speed=0.5", "second_device"}) {
    EXPECT_EQ(measure(fault, 3.0).revolutions, 0u) << fault;
  }
}

INSTANTIATE_TEST_SUITE_P(Mode, OfEachFormat, ::testing::Range(std::size_t{0}, std::size_t{6}),
                         [](const auto& test) { return "Mode" + std::to_string(test.param); });

void expect_stamps_to_follow(double clock_error, double duration) {
  EmulatorSettings settings = without_noise();
  settings.clock_error = clock_error;
  settings.faults = "lost_frames=0.02";
  const MeasuredRoom room = measure_room(settings, 1,
                                         {.seconds = duration,
                                          .lateness = 0.004,
                                          .speeds = {8, 14, 10, 12, 9, 13, 8, 14},
                                          .judges_points = false});
  EXPECT_GT(static_cast<double>(room.revolutions), 9.0 * duration);
  EXPECT_LT(room.worst_stamp, 1e-3) << clock_error;
  ASSERT_TRUE(room.period);
  EXPECT_NEAR(*room.period, 108e-6 * (1.0 + clock_error), 108e-6 * 50e-6);
}

TEST(Stamps, FollowASlowClockForTenMinutes) { expect_stamps_to_follow(0.02, 600.0); }

TEST(Stamps, FollowAFastClock) { expect_stamps_to_follow(-0.02, 120.0); }

}  // namespace
}  // namespace quoin::sensor_bridge::rplidar
