// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "sensor_bridge/rplidar/protocol/revolution.hpp"

#include <algorithm>
#include <random>

#include <gtest/gtest.h>

#include "tests/sensor_bridge/rplidar/protocol/revolving_sensor.hpp"

namespace quoin::sensor_bridge::rplidar {
namespace {

constexpr double delay = 3.3e-3;
constexpr double period = 108e-6;

double between(TimePoint from, TimePoint to) {
  return std::chrono::duration<double>(to - from).count();
}

/// Adds the next block as soon as it can be read.
bool add_next(RevolutionAssembler& assembler, RevolvingSensor& sensor, Revolution& revolution) {
  const SampleBlock block = sensor.next();
  return assembler.add(block, sensor.arrival(delay), revolution);
}

/// Adds blocks until a revolution is complete.
Revolution next_revolution(RevolutionAssembler& assembler, RevolvingSensor& sensor) {
  Revolution revolution;
  for (int block = 0; block < 100; ++block) {
    if (add_next(assembler, sensor, revolution)) return revolution;
  }
  ADD_FAILURE() << "no revolution in 100 blocks";
  return revolution;
}

void expect_rising_times(const Revolution& revolution) {
  ASSERT_EQ(revolution.time_offset.size(), revolution.angle_q16.size());
  ASSERT_FALSE(revolution.time_offset.empty());
  EXPECT_EQ(revolution.time_offset.front(), 0.0F);
  for (std::size_t i = 1; i < revolution.time_offset.size(); ++i) {
    ASSERT_GT(revolution.time_offset[i], revolution.time_offset[i - 1]) << i;
  }
  EXPECT_LT(static_cast<double>(revolution.time_offset.back()),
            between(revolution.begin, revolution.end));
}

TEST(RevolutionAssembler, BeginsWithTheFirstWholeRevolution) {
  // At 90 degrees: a quarter is over, and sample 695 is the first one behind zero.
  RevolvingSensor sensor{.begin_angle = 90.0};
  RevolutionAssembler assembler(period, delay);
  for (std::size_t turn = 0; turn < 3; ++turn) {
    const Revolution revolution = next_revolution(assembler, sensor);
    const std::size_t first = 695 + 926 * turn;
    ASSERT_EQ(revolution.angle_q16.size(), 926u);
    ASSERT_EQ(revolution.quality.size(), 926u);
    EXPECT_TRUE(std::ranges::is_sorted(revolution.angle_q16));
    EXPECT_EQ(revolution.gaps, 0u);
    EXPECT_NEAR(between(sensor.time_of(first), revolution.begin), 0.0, 1e-6);
    EXPECT_NEAR(between(sensor.time_of(first + 926), revolution.end), 0.0, 1e-6);
    for (std::size_t i = 0; i < 926; ++i) {
      ASSERT_EQ(revolution.distance_q2[i], first + i);
      ASSERT_NEAR(revolution.time_offset[i], static_cast<double>(i) * period, 1e-6);
    }
  }
}

TEST(RevolutionAssembler, CountsGapsAndKeepsTheTimesBehindThem) {
  RevolvingSensor sensor;
  RevolutionAssembler assembler(period, delay);
  (void)next_revolution(assembler, sensor);
  sensor.lose_block();
  Revolution revolution;
  for (int block = 0; block < 3; ++block) {
    ASSERT_FALSE(add_next(assembler, sensor, revolution));
  }
  sensor.lose_block();
  revolution = next_revolution(assembler, sensor);
  ASSERT_EQ(revolution.angle_q16.size(), 926u - 80u);
  EXPECT_EQ(revolution.gaps, 2u);
  expect_rising_times(revolution);
  for (std::size_t i = 0; i < revolution.time_offset.size(); ++i) {
    const std::size_t sample = revolution.distance_q2[i];
    ASSERT_NEAR(between(sensor.time_of(sample), revolution.begin) +
                    static_cast<double>(revolution.time_offset[i]),
                0.0, 1e-6);
  }
  EXPECT_EQ(next_revolution(assembler, sensor).gaps, 0u);
}

TEST(RevolutionAssembler, BlamesBothSidesForAGapAtZero) {
  RevolvingSensor sensor;
  RevolutionAssembler assembler(period, delay);
  (void)next_revolution(assembler, sensor);
  Revolution revolution;
  while (sensor.sent % 926 < 926 - 40) {
    ASSERT_FALSE(add_next(assembler, sensor, revolution));
  }
  sensor.lose_block();
  EXPECT_TRUE(add_next(assembler, sensor, revolution));
  EXPECT_EQ(revolution.gaps, 1u);
  EXPECT_EQ(next_revolution(assembler, sensor).gaps, 1u);
  EXPECT_EQ(next_revolution(assembler, sensor).gaps, 0u);
}

TEST(RevolutionAssembler, GivesRisingTimesWhateverTheArrivals) {
  RevolvingSensor sensor;
  RevolutionAssembler assembler(period, delay);
  std::mt19937 random(20260422);
  std::exponential_distribution<double> lateness(1.0 / 5e-3);
  Revolution revolution;
  TimePoint last_arrival;
  int complete = 0;
  for (int block = 0; block < 3000; ++block) {
    if (random() % 100 == 0) sensor.lose_block();
    const SampleBlock samples = sensor.next();
    const TimePoint arrival =
        std::max(last_arrival, sensor.arrival(delay) + seconds(lateness(random)));
    last_arrival = arrival;
    if (!assembler.add(samples, arrival, revolution)) continue;
    ++complete;
    expect_rising_times(revolution);
  }
  EXPECT_GT(complete, 120);
}

TEST(RevolutionAssembler, PutsRightWhatCameLateAtFirst) {
  RevolvingSensor sensor{.begin_angle = 359.0};
  RevolutionAssembler assembler(period, delay);
  Revolution revolution;
  bool complete = false;
  for (int block = 0; !complete && block < 100; ++block) {
    const SampleBlock samples = sensor.next();
    const double late = block < 5 ? 20e-3 - block * 4e-3 : 0.0;
    complete = assembler.add(samples, sensor.arrival(delay) + seconds(late), revolution);
  }
  ASSERT_TRUE(complete);
  expect_rising_times(revolution);
  EXPECT_NEAR(between(sensor.time_of(revolution.distance_q2[0]), revolution.begin), 0.0, 1e-6);
  EXPECT_NEAR(between(revolution.begin, revolution.end), 926 * period, 1e-6);
}

/// A block of these angles [deg] one sample period after another.
SampleBlock block_of(std::initializer_list<double> angles, bool after_gap = false) {
  SampleBlock block;
  block.after_gap = after_gap;
  block.samples_per_turn = 36.0;
  for (const double angle : angles) {
    block.angle_q16[block.size] = static_cast<std::uint32_t>(angle * 65536.0);
    block.distance_q2[block.size] = 4000;
    block.quality[block.size] = 188;
    ++block.size;
  }
  block.age = block.size - 1;
  return block;
}

TEST(RevolutionAssembler, CutsOnceWhereCorrectionsStepBackOverZero) {
  constexpr double pace = 12.5e-3;  // eight samples in 0.1 s
  RevolutionAssembler assembler(pace, 0.0);
  TimePoint arrival;
  const auto add = [&](SampleBlock block, Revolution& revolution) {
    block.samples_per_turn = 8.0;
    arrival += seconds(pace * static_cast<double>(block.size));
    return assembler.add(block, arrival, revolution);
  };
  Revolution revolution;
  EXPECT_FALSE(add(block_of({350.0, 359.5, 0.5, 359.75, 1.0}, true), revolution));
  EXPECT_FALSE(add(block_of({90.0, 89.0, 180.0, 270.0}), revolution));
  EXPECT_TRUE(add(block_of({359.0, 0.25, 359.5, 0.75, 1.0}), revolution));
  EXPECT_EQ(revolution.angle_q16.size(), 3u + 4u + 1u);
  EXPECT_FALSE(add(block_of({120.0, 240.0}), revolution));
  EXPECT_TRUE(add(block_of({358.0, 0.0}), revolution));
  EXPECT_EQ(revolution.angle_q16.size(), 4u + 2u + 1u);
}

TEST(RevolutionAssembler, IsNotMisledByOneWrongAngle) {
  constexpr double pace = 0.1 / 36;
  for (const double wrong : {10.0, 100.0, 200.0, 350.0}) {
    RevolutionAssembler assembler(pace, 0.0);
    TimePoint arrival;
    Revolution revolution;
    int complete = 0;
    for (int turn = 0; turn < 6; ++turn) {
      for (int step = 0; step < 36; ++step) {
        const double angle = turn == 2 && step == 9 ? wrong : 10.0 * step + 1.0;
        arrival += seconds(pace);
        if (assembler.add(block_of({angle}), arrival, revolution)) ++complete;
      }
    }
    EXPECT_EQ(complete, 4) << wrong;
    EXPECT_EQ(revolution.angle_q16.size(), 36u) << wrong;
  }
}

TEST(RevolutionAssembler, DropsTheRevolutionOfAMotorThatStandsStill) {
  RevolvingSensor sensor;
  RevolutionAssembler assembler(period, delay);
  (void)next_revolution(assembler, sensor);
  Revolution revolution;
  for (std::size_t sample = 0; sample < 2 * RevolutionAssembler::largest_revolution; sample += 4) {
    ASSERT_FALSE(
        assembler.add(block_of({20.0, 20.0, 20.0, 20.0}), sensor.arrival(delay), revolution));
  }
  // What was left of this revolution is discarded as at the very begin.
  revolution = next_revolution(assembler, sensor);
  EXPECT_EQ(revolution.angle_q16.size(), 926u);
}

TEST(RevolutionAssembler, TakesEmptyBlocks) {
  RevolutionAssembler assembler(period, delay);
  Revolution revolution;
  EXPECT_FALSE(assembler.add(SampleBlock{}, TimePoint{}, revolution));
}

}  // namespace
}  // namespace quoin::sensor_bridge::rplidar
