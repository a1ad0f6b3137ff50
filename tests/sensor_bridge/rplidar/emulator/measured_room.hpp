// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "core/simulation/random.hpp"
#include "sensor_bridge/rplidar/protocol/revolution.hpp"
#include "sensor_bridge/rplidar/protocol/sample_decoder.hpp"
#include "tests/sensor_bridge/rplidar/emulator/device_on_bench.hpp"

namespace quoin::sensor_bridge::rplidar {

/// What a bridge makes of an emulated device without noise in the small room.
struct MeasuredRoom {
  std::size_t revolutions = 0;
  std::size_t points = 0;        ///< with a range
  std::size_t wrong_points = 0;  ///< farther from the walls than three times the noise of an S1
  double worst_point = 0.0;      ///< [m]
  std::uint64_t lost_samples = 0;
  std::uint64_t affected_samples = 0;  ///< of frames that were lost, repeated or made late
  double worst_stamp = 0.0;            ///< [s] of the first sample of a revolution
  std::optional<double> period;        ///< [s] measured, of a sample
  std::uint64_t impossible_revolutions = 0;
  DecoderCounts counts;
};

inline double distance_to_walls(const World& world, double x, double y) {
  double least = std::numeric_limits<double>::infinity();
  for (const auto& wall : world.walls) {
    const double dx = wall.end.x() - wall.start.x();
    const double dy = wall.end.y() - wall.start.y();
    const double along = std::clamp(
        ((x - wall.start.x()) * dx + (y - wall.start.y()) * dy) / (dx * dx + dy * dy), 0.0, 1.0);
    least = std::min(least,
                     std::hypot(x - wall.start.x() - along * dx, y - wall.start.y() - along * dy));
  }
  return least;
}

struct RoomTrial {
  double seconds = 24.0;
  double lateness = 0.0;  ///< [s] by which reads are late at most; every fourth is not
  /// Speeds [rev/s] one after the other, each for the same time; empty leaves it alone.
  std::vector<double> speeds = {};
  bool judges_points = true;
};

/// `mode` is its index. Faults of the settings begin with the device, before the scan.
inline MeasuredRoom measure_room(EmulatorSettings settings, std::size_t mode_index,
                                 const RoomTrial& trial = {}) {
  constexpr double tolerance = 3 * 0.010;
  const World world = small_room();
  settings.range_stddev = 0.0;
  settings.spin_up_time = std::min(settings.spin_up_time, 0.1);
  DeviceOnBench bench(settings, world);
  const DeviceIdentity& identity = bench.device().identity();
  const ScanMode mode = identity.modes.at(mode_index);
  if (identity.motor == MotorControl::pwm) (void)bench.ask("A5 F0 02 94 02 C1", 0.01);
  Bytes bytes =
      mode.format == SampleFormat::standard
          ? bench.ask(scan_request, 0.001)
          : bench.ask(express_scan_request(static_cast<std::uint8_t>(mode.id)).bytes(), 0.001);
  std::span<const std::uint8_t> rest(bytes);
  DescriptorScanner scanner;
  const auto descriptor = scanner.next(rest);
  const SampleFormat format =
      descriptor ? sample_format(descriptor->type).value_or(mode.format) : mode.format;

  const double line_time = static_cast<double>(layout_of(format).bytes) * 10.0 / identity.baud_rate;
  SampleDecoder decoder(format);
  RevolutionAssembler assembler(mode.sample_period, line_time);
  SampleBlock block;
  Revolution revolution;
  MeasuredRoom room;
  Random random(3);
  struct Turned {
    double time;
    double turns;
  };
  std::vector<Turned> turned{{bench.time(), bench.device().turns(bench.now())}};
  const auto judge = [&] {
    ++room.revolutions;
    const Pose2 pose = world.pose_at(0.0);
    for (std::size_t i = 0; i < revolution.angle_q16.size() && trial.judges_points; ++i) {
      if (revolution.distance_q2[i] == 0) continue;
      ++room.points;
      const double heading = pose.theta - 2.0 * std::numbers::pi * revolution.angle_q16[i] /
                                              static_cast<double>(full_circle_q16);
      const double range = revolution.distance_q2[i] / 4000.0;
      const double off = distance_to_walls(world, pose.x + range * std::cos(heading),
                                           pose.y + range * std::sin(heading));
      room.worst_point = std::max(room.worst_point, off);
      if (off > tolerance) ++room.wrong_points;
    }
    // The sample nearest to half a turn, whose time the motor knows.
    std::size_t half = 0;
    for (std::size_t i = 1; i < revolution.angle_q16.size(); ++i) {
      const auto away = [&](std::size_t k) {
        return std::abs(static_cast<double>(revolution.angle_q16[k]) - full_circle_q16 / 2.0);
      };
      if (away(i) < away(half)) half = i;
    }
    const double stamp = seconds_between(bench.start, revolution.begin) +
                         static_cast<double>(revolution.time_offset[half]);
    const double angle = revolution.angle_q16[half] / static_cast<double>(full_circle_q16);
    double least = 1.0;
    const std::size_t few = std::min<std::size_t>(turned.size(), 200);
    for (auto later = turned.end() - static_cast<std::ptrdiff_t>(few) + 1; later < turned.end();
         ++later) {
      const Turned& from = *(later - 1);
      const double target = std::floor(later->turns - angle) + angle;
      if (target < from.turns) continue;
      const double truth = from.time + (target - from.turns) / (later->turns - from.turns) *
                                           (later->time - from.time);
      least = std::min(least, std::abs(stamp - truth));
    }
    room.worst_stamp = std::max(room.worst_stamp, least);
  };
  std::size_t speed = 0;
  while (bench.time() < trial.seconds) {
    if (!trial.speeds.empty()) {
      const auto due = static_cast<std::size_t>(bench.time() / trial.seconds *
                                                static_cast<double>(trial.speeds.size()));
      if (due != speed || bench.time() < 0.01) {
        speed = due;
        const auto rpm = static_cast<std::uint16_t>(std::lround(60.0 * trial.speeds.at(due)));
        bench.device().receive(motor_speed_request(rpm).bytes(), bench.now());
      }
    }
    const auto next = bench.device().next_event();
    const double pause = next ? seconds_between(bench.now(), *next) : 0.01;
    const double late = random.index(4) == 0 ? 0.0 : random.uniform() * trial.lateness;
    bytes = bench.wait(std::max(0.0, pause) + late);
    const double turns = bench.device().turns(bench.now());
    if (turns > turned.back().turns) turned.push_back({bench.time(), turns});
    rest = bytes;
    while (decoder.next(rest, block)) {
      if (assembler.add(block, bench.now(), revolution)) judge();
    }
  }
  room.lost_samples = assembler.lost_samples();
  room.affected_samples = bench.device().counts().faulty_frames * layout_of(mode.format).samples;
  room.period = assembler.clock().measured_period();
  room.impossible_revolutions = assembler.impossible_revolutions();
  room.counts = decoder.counts();
  return room;
}

}  // namespace quoin::sensor_bridge::rplidar
