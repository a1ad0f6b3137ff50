// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include "sensor_bridge/rplidar/protocol/sample_decoder.hpp"
#include "tests/sensor_bridge/rplidar/emulator/device_on_bench.hpp"

namespace quoin::sensor_bridge::rplidar {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

constexpr double capsule_time = 39 * 108e-6 + 84 * 10.0 / 256000.0;  // [s] measuring and sending

TEST(DeviceScan, BeginsWhenTheSpeedIsStable) {
  DeviceOnBench bench;
  EXPECT_EQ(bench.ask(dense_scan_request, 0.1), hex("A5 5A 54 00 00 40 85"));
  EXPECT_EQ(bench.device().state(), DeviceState::spinning_up);
  EXPECT_NEAR(bench.device().motor_speed(bench.now()), 1.0, 1e-9);
  EXPECT_THAT(bench.wait(0.9 + capsule_time - 1e-6), IsEmpty());
  EXPECT_EQ(bench.device().state(), DeviceState::scanning);
  EXPECT_EQ(bench.wait(2e-6).size(), 84U);
  EXPECT_THAT(bench.events(), ElementsAre("0 ms express_scan in mode 1", "0 ms state: spinning up",
                                          "1000 ms state: scanning"));
}

TEST(DeviceScan, BeginsAtOnceWhenForced) {
  DeviceOnBench bench;
  EXPECT_EQ(bench.ask("A5 21", 0.0004).size(), 7U);
  EXPECT_EQ(bench.device().state(), DeviceState::scanning);
  EXPECT_NEAR(static_cast<double>(bench.wait(0.5).size()), 0.5 / 244e-6 * 5.0, 15.0);
}

TEST(DeviceScan, KeepsThePaceOfTheSerialLine) {
  DeviceOnBench bench;
  (void)bench.ask(dense_scan_request, 1.5);
  EXPECT_NEAR(static_cast<double>(bench.wait(10.0).size()), 84.0 * 10.0 / (40 * 108e-6), 84.0);
  (void)bench.ask(scan_request, 1.5);
  EXPECT_NEAR(static_cast<double>(bench.wait(10.0).size()), 5.0 * 10.0 / 244e-6, 5.0);
  EXPECT_EQ(bench.device().counts().lost_bytes, 0U);
}

TEST(DeviceScan, LosesFramesOnASlowLine) {
  EmulatorSettings settings = without_noise();
  settings.baud_rate = 115200;
  DeviceOnBench bench(settings);
  (void)bench.ask(dense_scan_request, 1.5);
  EXPECT_NEAR(static_cast<double>(bench.wait(10.0).size()), 115200.0, 84.0);
  EXPECT_GT(bench.device().counts().lost_bytes, 50000U);
}

TEST(DeviceScan, MarksTheFirstCapsuleOnly) {
  DeviceOnBench bench;
  for (int scan = 0; scan < 2; ++scan) {
    (void)bench.ask(dense_scan_request, 0.1);
    const Bytes stream = bench.wait(2.0);
    ASSERT_GT(stream.size(), 84U * 100U);
    for (std::size_t i = 0; i + 84 <= stream.size(); i += 84) {
      EXPECT_EQ((stream[i + 3] & 0x80) != 0, i == 0) << i;
    }
    (void)bench.ask(stop_request);
  }
}

TEST(DeviceScan, EndsWithStop) {
  DeviceOnBench bench;
  (void)bench.ask(dense_scan_request, 2.0);
  (void)bench.ask(stop_request, 0.01);  // what is on the line
  EXPECT_THAT(bench.wait(1.0), IsEmpty());
  EXPECT_EQ(bench.device().state(), DeviceState::idle);
  EXPECT_EQ(bench.device().motor_speed(bench.now()), 0.0);
}

TEST(DeviceScan, EndsWithAQuestionWhichIsAnsweredBehindWhatIsOnTheLine) {
  DeviceOnBench bench;
  (void)bench.ask(dense_scan_request, 2.0);
  const Bytes rest = bench.ask("A5 52", 0.1);
  const Bytes answer = hex("A5 5A 03 00 00 00 06 00 00 00");
  ASSERT_GE(rest.size(), answer.size());
  EXPECT_LE(rest.size(), 84U + answer.size());
  EXPECT_TRUE(std::equal(answer.rbegin(), answer.rend(), rest.rbegin()));
  EXPECT_THAT(bench.wait(1.0), IsEmpty());
}

TEST(DeviceScan, BeginsAnewInMidScan) {
  DeviceOnBench bench;
  (void)bench.ask(dense_scan_request, 2.0);  // a capsule is on the line
  const Bytes bytes = bench.ask(dense_scan_request, 0.02);
  ASSERT_GT(bytes.size(), 84U + 7U + 84U);
  EXPECT_EQ(Bytes(bytes.begin() + 84, bytes.begin() + 91), hex("A5 5A 54 00 00 40 85"));
  EXPECT_EQ(bytes[91 + 3] & 0x80, 0x80);
  EXPECT_EQ(bench.device().state(), DeviceState::scanning);  // the motor turns already
}

TEST(DeviceScan, InOldExpressModeIsDense) {
  DeviceOnBench bench;
  EXPECT_EQ(bench.ask("A5 82 05 00 00 00 00 00 22"), hex("A5 5A 54 00 00 40 85"));
}

TEST(DeviceScan, GoesOnWhileTheSpeedChanges) {
  DeviceOnBench bench;
  (void)bench.ask(dense_scan_request, 2.0);
  const std::size_t before = bench.device().counts().frames;
  (void)bench.ask(motor_speed_request(900).bytes(), 1.0);
  EXPECT_EQ(bench.device().motor_speed(bench.now()), 15.0);
  EXPECT_NEAR(static_cast<double>(bench.device().counts().frames - before), 1.0 / (40 * 108e-6),
              1.0);
  (void)bench.ask(motor_speed_request(2000).bytes(), 1.0);
  EXPECT_EQ(bench.device().motor_speed(bench.now()), 15.0);
  (void)bench.ask(motor_speed_request(100).bytes(), 1.0);
  EXPECT_EQ(bench.device().motor_speed(bench.now()), 8.0);
  (void)bench.ask(motor_speed_request(0).bytes(), 1.0);
  EXPECT_EQ(bench.device().motor_speed(bench.now()), 0.0);
  EXPECT_EQ(bench.device().state(), DeviceState::idle);
}

TEST(DeviceScan, EndsWithAResetWhichMakesDeaf) {
  DeviceOnBench bench;
  (void)bench.ask(dense_scan_request, 2.0);
  (void)bench.ask(motor_speed_request(900).bytes());
  EXPECT_THAT(bench.ask("A5 40", 1.5), IsEmpty());
  EXPECT_EQ(bench.device().state(), DeviceState::resetting);
  EXPECT_THAT(bench.ask("A5 50", 0.49), IsEmpty());
  EXPECT_THAT(bench.wait(0.02), IsEmpty());
  EXPECT_EQ(bench.device().state(), DeviceState::idle);
  EXPECT_EQ(bench.ask("A5 50").size(), 27U);
  EXPECT_EQ(bench.device().counts().resets, 1U);
  (void)bench.ask(dense_scan_request, 2.0);
  EXPECT_EQ(bench.device().motor_speed(bench.now()), 10.0);  // the usual one
}

TEST(DeviceScan, GivesTheSameBytesHoweverOftenItIsAsked) {
  EmulatorSettings settings;
  settings.seed = 5;
  settings.faults = "wrong_checksums=0.2@1500ms+500ms, speed=12@2s+1s, dropped_bytes=0.01@3s+1s";
  DeviceOnBench coarse(settings);
  DeviceOnBench fine(settings);
  const Bytes all = coarse.ask(dense_scan_request, 5.0);
  Bytes pieces = fine.ask(dense_scan_request, 0.0);
  while (fine.time() < 5.0) {
    const auto next = fine.device().next_event();
    ASSERT_TRUE(next);
    const double pause = std::min(seconds_between(fine.now(), *next), 5.0 - fine.time());
    ASSERT_GE(pause, 0.0);
    pieces = pieces + fine.wait(pause);
  }
  EXPECT_EQ(pieces, all);
  EXPECT_EQ(fine.events(), coarse.events());
}

TEST(DeviceScan, WaitsForNothingWhenIdle) {
  DeviceOnBench bench;
  EXPECT_EQ(bench.device().next_event(), std::nullopt);
  (void)bench.ask(dense_scan_request, 3.0);
  EXPECT_NE(bench.device().next_event(), std::nullopt);
  (void)bench.ask(stop_request, 1.0);
  EXPECT_EQ(bench.device().next_event(), std::nullopt);
}

}  // namespace
}  // namespace quoin::sensor_bridge::rplidar
