// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <numbers>

#include <gtest/gtest.h>

#include "sensor_bridge/rplidar/protocol/sample_decoder.hpp"
#include "tests/sensor_bridge/rplidar/emulator/device_on_bench.hpp"

namespace quoin::sensor_bridge::rplidar {
namespace {

// What a format cannot tell more exactly.
struct Exactness {
  std::uint16_t mode;
  double angle;                      // [deg]
  double (*distance)(double range);  // [mm], of a range [mm]
};

constexpr double half_q6 = 1.0 / 128.0;
constexpr double measured = 0.125;  // [mm] the device itself counts quarters

constexpr Exactness exactnesses[] = {
    {0, half_q6, [](double) { return measured; }},
    {1, 2 * half_q6, [](double) { return measured + 0.5; }},
    {2, 2 * half_q6, [](double) { return measured + 0.5; }},
    {3, 0.5 * 90.0 / 16384.0, [](double) { return measured; }},
    // Steps of 1, 2, 4 and 8 mm, which change at 512, 2048 and 4096 mm of a neighbour's range, from
    // whole millimetres. The parallax is reckoned in steps of 64/65536 rad.
    {4, 2 * half_q6 + 0.06,
     [](double range) {
       return measured + 0.5 + (range < 500 ? 0.0 : range < 2000 ? 1.0 : range < 4000 ? 2.0 : 4.0);
     }},
    // Steps of 2, 3 and 4 mm; readers smooth the finest ones with a neighbour.
    {5, 2 * half_q6,
     [](double range) {
       return measured + (range < 2046 ? 2.0 : range < 8187 ? 1.5 : 2.0);
     }},
};

// Where the room is convex, so that the range changes with the angle without jumps.
std::pair<double, double> range_limits(const World& world, const Pose2& pose, double angle,
                                       double tolerance) {
  double nearest = 1e9;
  double farthest = 0.0;
  for (int i = -4; i <= 4; ++i) {
    const double heading = pose.theta - (angle + i / 4.0 * tolerance) * std::numbers::pi / 180.0;
    const double range =
        1e3 * cast_ray(world, {pose.x, pose.y}, {std::cos(heading), std::sin(heading)}).distance;
    nearest = std::min(nearest, range);
    farthest = std::max(farthest, range);
  }
  return {nearest, farthest};
}

void expect_ranges_as_in_the_room(const EmulatorSettings& settings, const Exactness& exactness,
                                  double time) {
  DeviceOnBench bench(settings);
  const ScanMode& mode = bench.device().identity().modes[exactness.mode];
  SCOPED_TRACE(mode.name);
  const World world = small_room();
  const Request request = exactness.mode == 0
                              ? Request(Command::scan)
                              : express_scan_request(static_cast<std::uint8_t>(exactness.mode));
  const Bytes bytes = bench.ask(request.bytes(), 1.0 + time);
  ASSERT_GT(bytes.size(), 7U);
  std::span<const std::uint8_t> stream(bytes);
  // Behind the first node, which is none of the room.
  stream = stream.subspan(exactness.mode == 0 ? 12 : 7);
  const std::size_t frames = stream.size() / layout_of(mode.format).bytes;

  SampleDecoder decoder(mode.format);
  SampleBlock block;
  std::uint64_t index = 0;
  double worst = 0.0;  // [mm] beyond what the angle explains
  std::size_t wrong_angles = 0;
  std::size_t wrong_distances = 0;
  while (decoder.next(stream, block)) {
    for (std::size_t i = 0; i < block.size; ++i, ++index) {
      const DeviceOnBench::TimePoint acquired = bench.device().sample_time(index);
      const double angle = block.angle_q16[i] / 65536.0;
      const double distance = block.distance_q2[i] / 4.0;
      if (mode.format != SampleFormat::ultra) {  // whose readers turn angles
        const double truth = 360.0 * bench.device().turns(acquired);
        if (std::abs(std::remainder(angle - truth, 360.0)) > exactness.angle) ++wrong_angles;
      }
      const Pose2 pose =
          world.pose_at(settings.speed * seconds_between(DeviceOnBench::start, acquired));
      const auto [nearest, farthest] = range_limits(world, pose, angle, exactness.angle);
      const double error = std::max({0.0, nearest - distance, distance - farthest});
      worst = std::max(worst, error);
      if (error > exactness.distance(distance) + 1e-6) ++wrong_distances;
    }
  }
  EXPECT_EQ(wrong_angles, 0U);
  EXPECT_EQ(wrong_distances, 0U) << "worst error " << worst << " mm";
  EXPECT_GT(worst, 0.0);
  ::testing::Test::RecordProperty("worst_error_mm_" + mode.name, std::to_string(worst));
  EXPECT_EQ(decoder.counts().checksum_errors, 0U);
  EXPECT_EQ(decoder.counts().skipped_bytes, 0U);
  EXPECT_EQ(decoder.counts().out_of_line, 0U);
  // All but the last capsule, which waits for the next one.
  EXPECT_EQ(decoder.counts().frames, frames);
  EXPECT_GE(index + 2 * layout_of(mode.format).samples, frames * layout_of(mode.format).samples);
  EXPECT_NEAR(static_cast<double>(index), time / mode.sample_period, 300.0);
}

EmulatorSettings all_formats() {
  EmulatorSettings settings = without_noise();
  settings.all_formats = true;
  return settings;
}

TEST(DeviceGeometry, IsThatOfTheRoomInEachFormat) {
  for (const Exactness& exactness : exactnesses) {
    expect_ranges_as_in_the_room(all_formats(), exactness, 3.0);
  }
}

TEST(DeviceGeometry, IsThatOfTheRoomAtTheTimeOfEachSample) {
  EmulatorSettings settings = all_formats();
  settings.speed = 1.0;
  settings.frequency = 15.0;
  settings.spin_up_time = 2.0 / 3.0;
  for (const Exactness& exactness : exactnesses) {
    expect_ranges_as_in_the_room(settings, exactness, 2.0);
  }
}

TEST(DeviceGeometry, HasTheNoiseThatIsAskedFor) {
  World world;  // round about the sensor
  world.pillars.push_back({{0.0, 0.0}, 3.0});
  world.path = {{0.0, 0.0, 0.0}};
  EmulatorSettings settings;
  settings.range_stddev = 0.02;
  DeviceOnBench bench(settings, world);
  const Bytes bytes = bench.ask(dense_scan_request, 11.0);
  std::span<const std::uint8_t> stream(bytes);
  stream = stream.subspan(7);
  SampleDecoder decoder(SampleFormat::dense);
  SampleBlock block;
  double sum = 0.0;
  double squares = 0.0;
  std::size_t count = 0;
  while (decoder.next(stream, block)) {
    for (std::size_t i = 0; i < block.size; ++i, ++count) {
      const double error = block.distance_q2[i] / 4000.0 - 3.0;
      sum += error;
      squares += error * error;
    }
  }
  ASSERT_GT(count, 90000U);
  const double size = static_cast<double>(count);
  EXPECT_NEAR(sum / size, 0.0, 4.0 * 0.02 / std::sqrt(size));
  EXPECT_NEAR(std::sqrt(squares / size), 0.02, 4.0 * 0.02 / std::sqrt(2.0 * size));
}

TEST(DeviceGeometry, HasNoReturnsOutOfReach) {
  World world;
  world.add_polyline({{30.0, -30.0}, {30.0, 30.0}}, false);  // 30 m ahead, over 40 m aside
  world.path = {{0.0, 0.0, 0.0}};
  DeviceOnBench bench(without_noise(), world);
  const Bytes bytes = bench.ask(dense_scan_request, 2.0);
  std::span<const std::uint8_t> stream(bytes);
  stream = stream.subspan(7);
  SampleDecoder decoder(SampleFormat::dense);
  SampleBlock block;
  const double limit = std::acos(30.0 / 40.0) * 180.0 / std::numbers::pi;
  while (decoder.next(stream, block)) {
    for (std::size_t i = 0; i < block.size; ++i) {
      const double angle = std::remainder(block.angle_q16[i] / 65536.0, 360.0);
      if (std::abs(std::abs(angle) - limit) < 0.1) continue;
      EXPECT_EQ(block.distance_q2[i] != 0, std::abs(angle) < limit) << angle;
      EXPECT_EQ(block.quality[i] != 0, std::abs(angle) < limit) << angle;
    }
  }
  EXPECT_GT(decoder.counts().samples, 9000U);
}

}  // namespace
}  // namespace quoin::sensor_bridge::rplidar
