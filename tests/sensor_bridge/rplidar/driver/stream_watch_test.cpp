// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "sensor_bridge/rplidar/driver/stream_watch.hpp"

#include <chrono>

#include <gtest/gtest.h>

#include "sensor_bridge/rplidar/driver/scan_stream.hpp"
#include "tests/sensor_bridge/rplidar/protocol/sample_stream.hpp"

namespace quoin::sensor_bridge::rplidar {
namespace {

using namespace std::chrono_literals;

class StreamWatchTest : public ::testing::Test {
 protected:
  std::optional<Finding> judge(std::chrono::milliseconds time) {
    return watch_.judge(start_ + time, counts_, bytes_);
  }
  void frames(std::uint64_t count) {
    counts_.frames += count;
    bytes_ += 84 * count;
  }
  void garbage(std::uint64_t bytes) {
    counts_.skipped_bytes += bytes;
    bytes_ += bytes;
  }

  TimePoint start_ = TimePoint() + 1h;
  StreamWatch watch_{TimeOuts{}, start_};
  DecoderCounts counts_;
  std::uint64_t bytes_ = 0;
};

TEST_F(StreamWatchTest, GivesAMotorTimeToSpinUp) {
  EXPECT_EQ(judge(7999ms), std::nullopt);
  EXPECT_EQ(judge(8000ms), Finding::silence);
}

TEST_F(StreamWatchTest, NoticesSilence) {
  frames(1);
  EXPECT_EQ(judge(500ms), std::nullopt);
  EXPECT_EQ(judge(1499ms), std::nullopt);
  EXPECT_EQ(judge(1500ms), Finding::silence);
}

TEST_F(StreamWatchTest, TellsBytesWithoutFramesFromSilence) {
  frames(1);
  EXPECT_EQ(judge(500ms), std::nullopt);
  garbage(100);
  EXPECT_EQ(judge(1500ms), Finding::no_frames);
}

TEST_F(StreamWatchTest, NoticesThatMostFramesAreDamaged) {
  frames(100);
  garbage(84 * 99);
  counts_.checksum_errors = 99;
  EXPECT_EQ(judge(1000ms), std::nullopt);  // just less than half
  frames(100);
  garbage(84 * 101);
  counts_.checksum_errors += 101;
  EXPECT_EQ(judge(1999ms), std::nullopt);  // judged by windows of 1 s
  EXPECT_EQ(judge(2000ms), Finding::damaged_frames);
}

TEST_F(StreamWatchTest, NoticesGarbageWithoutChecksums) {
  frames(1);
  garbage(1000);
  EXPECT_EQ(judge(1000ms), Finding::no_frames);
}

TEST_F(StreamWatchTest, NoticesAMotorThatStandsStill) {
  for (int time = 100; time < 8100; time += 100) {
    frames(20);
    ASSERT_EQ(judge(std::chrono::milliseconds(time)), std::nullopt) << time;
  }
  frames(20);
  EXPECT_EQ(judge(8100ms), Finding::no_revolution);
}

TEST_F(StreamWatchTest, NoticesAMotorThatStops) {
  frames(20);
  EXPECT_EQ(judge(100ms), std::nullopt);
  watch_.note_revolution(start_ + 100ms);
  for (int time = 200; time < 3100; time += 100) {
    frames(20);
    ASSERT_EQ(judge(std::chrono::milliseconds(time)), std::nullopt) << time;
  }
  frames(20);
  EXPECT_EQ(judge(3100ms), Finding::no_revolution);
}

TEST_F(StreamWatchTest, IsStableAfterAWhileOfMeasurements) {
  EXPECT_FALSE(watch_.stable(start_ + 1h));
  frames(20);
  EXPECT_EQ(judge(100ms), std::nullopt);
  watch_.note_revolution(start_ + 200ms);
  EXPECT_FALSE(watch_.stable(start_ + 5099ms));
  EXPECT_TRUE(watch_.stable(start_ + 5100ms));
}

class RotationWatchTest : public ::testing::Test {
 protected:
  std::optional<double> turn(double speed) {
    Revolution revolution;
    revolution.begin = now_;
    now_ += std::chrono::duration_cast<std::chrono::nanoseconds>(
        std::chrono::duration<double>(60.0 / speed));
    revolution.end = now_;
    return watch_.note(revolution);
  }

  TimePoint now_ = TimePoint() + 1h;
  RotationWatch watch_{600, now_ + 2s};
};

TEST_F(RotationWatchTest, TellsOnceOfAFewWrongRevolutions) {
  EXPECT_FALSE(turn(600));
  EXPECT_FALSE(turn(530));
  EXPECT_FALSE(turn(530));
  EXPECT_FALSE(turn(545));  // within the tolerance
  EXPECT_FALSE(turn(530));
  EXPECT_FALSE(turn(530));
  EXPECT_NEAR(turn(530).value_or(0), 530, 1e-3);
  EXPECT_FALSE(turn(530));
  EXPECT_FALSE(turn(600));
  EXPECT_FALSE(turn(700));
  EXPECT_FALSE(turn(700));
  EXPECT_NEAR(turn(700).value_or(0), 700, 1e-3);
}

TEST_F(RotationWatchTest, BearsWithASpinUp) {
  for (int i = 0; i < 9; ++i) EXPECT_FALSE(turn(300));  // 1.8 s
  EXPECT_FALSE(turn(300));
  EXPECT_FALSE(turn(300));
  EXPECT_TRUE(turn(300));
}

TEST_F(RotationWatchTest, SaysNothingOfASpeedThatWasNotSet) {
  watch_ = RotationWatch(std::nullopt, now_);
  for (int i = 0; i < 9; ++i) EXPECT_FALSE(turn(300));
}

/// A capsule of 84 bytes is 3.28 ms on a line of 256000 bit/s, whatever carries it from there on.
TEST(ScanStream, StampsCountTheLineBehindTheDevice) {
  const ScanMode mode{.id = 1,
                      .name = "DenseBoost",
                      .sample_period = 108e-6,
                      .range_max = 40.0,
                      .format = SampleFormat::dense};
  const auto begin_with = [&](double line_rate) {
    ScanStream stream(mode, line_rate, SampleFormat::dense);
    std::optional<TimePoint> begin;
    constexpr unsigned step_q6 = 1002;
    for (unsigned number = 0; number < 60; ++number) {
      stream.take(dense_capsule(number * step_q6 % (360 * 64), 4000, number == 0),
                  TimePoint() + 1h + number * 4320us,
                  [&](const Revolution& revolution) { begin = revolution.begin; });
    }
    return begin;
  };
  const auto known = begin_with(256000.0);
  const auto unknown = begin_with(0.0);
  ASSERT_TRUE(known && unknown);
  EXPECT_NEAR(std::chrono::duration<double>(*unknown - *known).count(), 840.0 / 256000.0, 1e-9);
}

}  // namespace
}  // namespace quoin::sensor_bridge::rplidar
