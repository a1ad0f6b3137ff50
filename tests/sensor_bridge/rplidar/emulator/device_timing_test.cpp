// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include <gtest/gtest.h>

#include "core/simulation/random.hpp"
#include "sensor_bridge/rplidar/protocol/revolution.hpp"
#include "sensor_bridge/rplidar/protocol/sample_decoder.hpp"
#include "tests/sensor_bridge/rplidar/emulator/device_on_bench.hpp"

namespace quoin::sensor_bridge::rplidar {
namespace {

constexpr double line_delay = 84 * 10.0 / 256000.0;  // [s] from a capsule's last sample to its end

struct Outcome {
  std::size_t revolutions = 0;
  std::size_t lost_samples = 0;
  std::size_t wrong_sizes = 0;  // revolutions of another size than the speed gives
  std::size_t gaps = 0;
  double worst_stamp = 0.0;  // [s]
  DecoderCounts counts;
};

/// Scans at 15 Hz for `duration` [s] of the device's time; bytes are fetched when they are there,
/// up to `lateness` [s] late, but every fourth time at once.
Outcome scan(double duration, double lateness, double clock_error) {
  EmulatorSettings settings = without_noise();
  settings.frequency = 15.0;
  settings.spin_up_time = 0.0;
  settings.clock_error = clock_error;
  DeviceOnBench bench(settings);
  EXPECT_EQ(bench.ask(dense_scan_request, 0.001).size(), 7U);

  const ScanMode mode = bench.device().identity().modes[1];
  SampleDecoder decoder(mode.format);
  RevolutionAssembler assembler(mode.sample_period, line_delay);
  SampleBlock block;
  Revolution revolution;
  Random random(3);
  Outcome outcome;
  std::uint64_t decoded = 0;
  std::optional<std::uint64_t> begin;  // number of the sample that the next revolution begins with
  std::uint32_t last_angle = 0;
  while (bench.time() < duration) {
    const double pause = seconds_between(bench.now(), *bench.device().next_event());
    const double late = random.index(4) == 0 ? 0.0 : random.uniform() * lateness;
    const Bytes bytes = bench.wait(std::max(0.0, pause) + late);
    std::span<const std::uint8_t> rest(bytes);
    while (decoder.next(rest, block)) {
      for (std::size_t i = 0; i < block.size && !begin; ++i) {
        if (block.angle_q16[i] < last_angle) begin = decoded + i;
        last_angle = block.angle_q16[i];
      }
      decoded += block.size;
      if (!assembler.add(block, bench.now(), revolution)) continue;
      ++outcome.revolutions;
      const std::size_t size = revolution.angle_q16.size();
      const double expected = 1.0 / 15.0 / (mode.sample_period * (1.0 + clock_error));
      if (std::abs(static_cast<double>(size) - expected) > 1.0) ++outcome.wrong_sizes;
      outcome.gaps += revolution.gaps;
      for (std::size_t i = 0; i < size; ++i) {
        const double stamp = seconds_between(bench.start, revolution.begin) +
                             static_cast<double>(revolution.time_offset[i]);
        const double truth = seconds_between(bench.start, bench.device().sample_time(*begin + i));
        outcome.worst_stamp = std::max(outcome.worst_stamp, std::abs(stamp - truth));
      }
      *begin += size;
    }
  }
  outcome.counts = decoder.counts();
  const std::uint64_t sent = bench.device().counts().frames * 40;
  outcome.lost_samples = sent - decoded;
  return outcome;
}

void expect_flawless(const Outcome& outcome, double duration) {
  EXPECT_NEAR(static_cast<double>(outcome.revolutions), 15.0 * duration, 2.0);
  EXPECT_LE(outcome.lost_samples, 80U);  // on the line, or waiting for the next capsule
  EXPECT_EQ(outcome.wrong_sizes, 0U);
  EXPECT_EQ(outcome.gaps, 0U);
  EXPECT_EQ(outcome.counts.checksum_errors, 0U);
  EXPECT_EQ(outcome.counts.skipped_bytes, 0U);
  EXPECT_EQ(outcome.counts.out_of_line, 0U);
}

TEST(DeviceTiming, IsKnownToASampleForTenMinutes) {
  const Outcome outcome = scan(600.0, 0.0, 0.0);
  expect_flawless(outcome, 600.0);
  EXPECT_LT(outcome.worst_stamp, 108e-6);
  RecordProperty("worst_stamp_us", std::to_string(1e6 * outcome.worst_stamp));
}

TEST(DeviceTiming, IsKnownToASampleThroughLateReads) {
  const Outcome outcome = scan(60.0, 0.004, 0.0);
  expect_flawless(outcome, 60.0);
  EXPECT_LT(outcome.worst_stamp, 108e-6);
  RecordProperty("worst_stamp_us", std::to_string(1e6 * outcome.worst_stamp));
}

TEST(DeviceTiming, IsKnownToASampleWithAnotherClock) {
  for (const double clock_error : {-200e-6, 200e-6}) {
    const Outcome outcome = scan(60.0, 0.004, clock_error);
    expect_flawless(outcome, 60.0);
    EXPECT_LT(outcome.worst_stamp, 108e-6) << clock_error;
  }
}

}  // namespace
}  // namespace quoin::sensor_bridge::rplidar
