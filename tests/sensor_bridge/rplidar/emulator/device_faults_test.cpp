// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include "sensor_bridge/rplidar/protocol/sample_decoder.hpp"
#include "tests/sensor_bridge/rplidar/emulator/device_on_bench.hpp"

namespace quoin::sensor_bridge::rplidar {
namespace {

using ::testing::Contains;
using ::testing::IsEmpty;

constexpr std::string_view good_health = "A5 5A 03 00 00 00 06 00 00 00";
constexpr std::string_view bad_health = "A5 5A 03 00 00 00 06 02 01 00";

DecoderCounts counts_of(SampleFormat format, const Bytes& bytes) {
  SampleDecoder decoder(format);
  SampleBlock block;
  std::span<const std::uint8_t> rest(bytes);
  while (decoder.next(rest, block)) {
  }
  return decoder.counts();
}

TEST(DeviceFaults, SilenceSendsNothing) {
  DeviceOnBench bench;
  (void)bench.ask(dense_scan_request, 2.0);
  bench.apply("silence@1s+500ms");
  EXPECT_GT(bench.wait(1.0).size(), 19000U);
  EXPECT_LE(bench.wait(0.5).size(), 84U);  // was on the line
  EXPECT_NEAR(static_cast<double>(bench.wait(1.0).size()), 19444.0, 168.0);
  EXPECT_EQ(bench.device().state(), DeviceState::scanning);
  EXPECT_THAT(bench.events(), Contains("3000 ms fault begins: silence@1s+0.5s"));
  EXPECT_THAT(bench.events(), Contains("3500 ms fault ends: silence@1s+0.5s"));
}

TEST(DeviceFaults, GarbageHasTheRightLengthOnly) {
  DeviceOnBench bench;
  const Bytes info = bench.ask("A5 50");
  bench.apply("garbage+1s");
  const Bytes garbage = bench.ask("A5 50");
  EXPECT_EQ(garbage.size(), info.size());
  std::size_t same = 0;
  for (std::size_t i = 0; i < info.size(); ++i) same += info[i] == garbage[i] ? 1 : 0;
  EXPECT_LT(same, 3U);
  (void)bench.wait(1.0);
  EXPECT_EQ(bench.ask("A5 50"), info);
}

TEST(DeviceFaults, ChecksumsAreWrongInAShareOfTheCapsules) {
  DeviceOnBench bench;
  bench.apply("wrong_checksums=0.3");
  (void)bench.ask(dense_scan_request, 1.0);
  const Bytes stream = bench.wait(20.0);
  const DecoderCounts counts = counts_of(SampleFormat::dense, stream);
  const double share =
      1.0 - static_cast<double>(counts.frames) / static_cast<double>(stream.size() / 84);
  EXPECT_NEAR(share, 0.3, 0.03);
  EXPECT_GT(counts.checksum_errors, 500U);
}

TEST(DeviceFaults, ChecksumsOfNodesAreTheirCheckBits) {
  DeviceOnBench bench;
  bench.apply("wrong_checksums=1");
  (void)bench.ask(scan_request, 1.0);
  const Bytes stream = bench.wait(1.0);
  EXPECT_GT(stream.size(), 20000U);
  // What is out of step may look like a node by chance.
  EXPECT_LT(counts_of(SampleFormat::standard, stream).samples, stream.size() / 5 / 5);
}

TEST(DeviceFaults, BytesGetLost) {
  DeviceOnBench bench;
  (void)bench.ask(dense_scan_request, 1.0);
  const double whole = static_cast<double>(bench.wait(10.0).size());
  bench.apply("dropped_bytes=0.002");
  const Bytes stream = bench.wait(10.0);
  EXPECT_NEAR(static_cast<double>(stream.size()) / whole, 0.998, 0.001);
  const DecoderCounts counts = counts_of(SampleFormat::dense, stream);
  EXPECT_GT(counts.frames, 1500U);  // 0.998^84 of 2315 are whole
  EXPECT_LT(counts.frames, 2200U);
  EXPECT_GT(counts.skipped_bytes, 5000U);
}

TEST(DeviceFaults, SpinUpTakesLonger) {
  DeviceOnBench bench;
  bench.apply("slow_spin_up=8");
  EXPECT_EQ(bench.ask(dense_scan_request, 8.0).size(), 7U);
  EXPECT_GT(bench.wait(0.1).size(), 1000U);
  EXPECT_THAT(bench.events(), Contains("8000 ms state: scanning"));
}

TEST(DeviceFaults, HealthErrorLastsUntilAReset) {
  DeviceOnBench bench;
  (void)bench.ask(dense_scan_request, 2.0);
  bench.apply("health_error@1s");
  (void)bench.wait(1.1);
  EXPECT_EQ(bench.device().state(), DeviceState::protection_stop);
  EXPECT_EQ(bench.ask("A5 52"), hex(bad_health));
  EXPECT_THAT(bench.ask(dense_scan_request), IsEmpty());
  EXPECT_THAT(bench.ask(scan_request, 10.0), IsEmpty());
  EXPECT_EQ(bench.ask("A5 50").size(), 27U);
  (void)bench.ask("A5 40", 2.1);
  EXPECT_EQ(bench.ask("A5 52"), hex(good_health));
  EXPECT_EQ(bench.ask(dense_scan_request).size(), 7U);
}

TEST(DeviceFaults, HealthErrorMayTakeSeveralResets) {
  DeviceOnBench bench;
  bench.apply("health_error=3");
  for (int reset = 0; reset < 3; ++reset) {
    EXPECT_EQ(bench.ask("A5 52"), hex(bad_health)) << reset;
    (void)bench.ask("A5 40", 2.1);
  }
  EXPECT_EQ(bench.ask("A5 52"), hex(good_health));
}

TEST(DeviceFaults, HealthErrorComesBackWhileItLasts) {
  DeviceOnBench bench;
  bench.apply("health_error+10s");
  (void)bench.ask("A5 40", 5.0);
  EXPECT_EQ(bench.ask("A5 52"), hex(bad_health));
  (void)bench.wait(6.0);
  EXPECT_EQ(bench.ask("A5 52"), hex(bad_health));  // no reset since
  (void)bench.ask("A5 40", 2.1);
  EXPECT_EQ(bench.ask("A5 52"), hex(good_health));
}

TEST(DeviceFaults, UnpluggingEndsEverything) {
  DeviceOnBench bench;
  (void)bench.ask(motor_speed_request(900).bytes());
  (void)bench.ask(dense_scan_request, 3.0);
  bench.apply("unplug+5s");
  EXPECT_EQ(bench.device().state(), DeviceState::unplugged);
  EXPECT_THAT(bench.wait(4.9), IsEmpty());
  EXPECT_THAT(bench.ask("A5 50", 0.2), IsEmpty());
  EXPECT_EQ(bench.device().state(), DeviceState::resetting);
  EXPECT_THAT(bench.wait(1.9), IsEmpty());
  EXPECT_EQ(bench.ask("A5 50").size(), 27U);
  (void)bench.ask(dense_scan_request, 3.0);
  EXPECT_EQ(bench.device().motor_speed(bench.now()), 10.0);  // it has forgotten the other
}

TEST(DeviceFaults, UnpluggedFromTheBeginning) {
  EmulatorSettings settings;
  settings.faults = "unplug+1s";
  DeviceOnBench bench(settings);
  EXPECT_EQ(bench.device().state(), DeviceState::unplugged);
  (void)bench.wait(3.1);
  EXPECT_EQ(bench.device().state(), DeviceState::idle);
}

TEST(DeviceFaults, SpeedIsNotThatOfTheClient) {
  DeviceOnBench bench;
  (void)bench.ask(dense_scan_request, 2.0);
  bench.apply("speed=15@1s+2s");
  (void)bench.wait(0.9);
  EXPECT_EQ(bench.device().motor_speed(bench.now()), 10.0);
  (void)bench.wait(1.0);
  EXPECT_EQ(bench.device().motor_speed(bench.now()), 15.0);
  EXPECT_EQ(bench.device().state(), DeviceState::scanning);
  (void)bench.wait(2.0);
  EXPECT_EQ(bench.device().motor_speed(bench.now()), 10.0);
}

TEST(DeviceFaults, AnswersMayBeAbsurd) {
  DeviceOnBench bench;
  bench.apply("zero_sample_time+1s");
  EXPECT_EQ(bench.ask("A5 59"), hex("A5 5A 04 00 00 00 15 00 00 00 00"));
  EXPECT_EQ(bench.ask("A5 84 06 71 00 00 00 01 00 57"),
            hex("A5 5A 08 00 00 00 20 71 00 00 00 00 00 00 00"));
  (void)bench.wait(1.0);
  bench.apply("wrong_length+1s");
  EXPECT_EQ(bench.ask("A5 52"), hex("A5 5A 06 00 00 00 06 00 00 00"));
  EXPECT_EQ(bench.ask(dense_scan_request), hex("A5 5A 57 00 00 40 85"));
  (void)bench.ask(stop_request, 2.0);
  bench.apply("unknown_model+1s");
  EXPECT_EQ(bench.ask("A5 50").at(7), 0x0F);
  (void)bench.wait(1.0);
  EXPECT_EQ(bench.ask("A5 50").at(7), 0x61);
  bench.apply("unknown_format");
  EXPECT_EQ(bench.ask("A5 84 06 75 00 00 00 01 00 53"), hex("A5 5A 05 00 00 00 20 75 00 00 00 99"));
  EXPECT_EQ(bench.ask(dense_scan_request), hex("A5 5A 54 00 00 40 99"));
}

TEST(DeviceFaults, EndWhenCleared) {
  DeviceOnBench bench;
  bench.apply("silence");
  bench.apply("unknown_model@1s");
  EXPECT_THAT(bench.ask("A5 52"), IsEmpty());
  bench.device().clear_faults(bench.now());
  EXPECT_EQ(bench.ask("A5 52", 2.0), hex(good_health));
  EXPECT_EQ(bench.ask("A5 50").at(7), 0x61);
  bench.apply("unplug");
  bench.device().clear_faults(bench.now());
  (void)bench.wait(2.1);
  EXPECT_EQ(bench.device().state(), DeviceState::idle);
}

}  // namespace
}  // namespace quoin::sensor_bridge::rplidar
