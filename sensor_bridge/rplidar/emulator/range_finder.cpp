// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "sensor_bridge/rplidar/emulator/range_finder.hpp"

#include <cmath>
#include <utility>

#include "core/simulation/scanner.hpp"
#include "sensor_bridge/rplidar/emulator/seconds.hpp"

namespace quoin::sensor_bridge::rplidar {

RangeFinder::RangeFinder(World world, const EmulatorSettings& settings, TimePoint start)
    : world_(std::move(world)),
      speed_(settings.speed),
      range_min_(settings.range_min),
      range_max_(settings.range_max),
      range_stddev_(settings.range_stddev),
      start_(start),
      random_(static_cast<std::uint64_t>(settings.seed)) {}

double RangeFinder::distance(double angle, TimePoint time) const {
  const Pose2 pose = world_.pose_at(speed_ * seconds_between(start_, time));
  const double heading = pose.theta - angle;
  return cast_ray(world_, {pose.x, pose.y}, {std::cos(heading), std::sin(heading)}).distance;
}

std::uint32_t RangeFinder::measure(double angle, TimePoint time) {
  const double range = distance(angle, time) + range_stddev_ * random_.normal();
  if (!(range >= range_min_ && range <= range_max_)) return 0;
  return static_cast<std::uint32_t>(std::llround(range * 4000.0));
}

}  // namespace quoin::sensor_bridge::rplidar
