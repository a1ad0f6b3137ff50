// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "sensor_bridge/simulated/simulated_source.hpp"

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <idl/Odometry.h>
#include <idl/Pose.h>
#include <limits>

#include "sensor_bridge/scan_declaration.hpp"
#include "sensor_bridge/simulated/parameters.hpp"
#include "sensor_bridge/simulated/revolution_timer.hpp"
#include "sensor_bridge/simulated/world_file.hpp"
#include "services/runtime/node/clock.hpp"
#include "services/topics/poses.hpp"

namespace quoin::sensor_bridge {
namespace {

using std::chrono::steady_clock;

/// What the robot under the sensor publishes beside the scans, by the same clock.
class RobotOutput {
 public:
  RobotOutput(const SimulatedParameters& parameters, steady_clock::time_point start)
      : parameters_(parameters),
        start_(start),
        // Not the seed of the scans, whose noise would go with that of the wheels.
        wheels_(wheel_errors(parameters),
                static_cast<std::uint64_t>(parameters.seed) + 0x9e3779b9U),
        // The robot stands until the first ray is cast, before which there is odometry, too.
        timer_(start - std::chrono::milliseconds(1), parameters.odometry_rate_hz) {
    odometry_.header().frame(parameters.odometry_frame);
    odometry_.child_frame(parameters.base_frame);
    truth_.header().frame(parameters.map_frame);
    truth_.child_frame(parameters.base_frame);
    truth_.weak_direction(std::numeric_limits<double>::quiet_NaN());
    next_ = timer_.next(start);
  }

  /// The odometry up to `end`, each message at its time. False when asked to stop.
  bool publish_odometry(const World& world, steady_clock::time_point end, runtime::Source& source) {
    for (; parameters_.odometry && next_.begin <= end; next_ = timer_.next(next_.begin)) {
      wheels_.move_to(pose_at(world, next_.begin));
      if (!source.wait_until(next_.begin)) return false;
      odometry_.header().stamp(runtime::epoch_ns(next_.begin));
      odometry_.pose(topics::pose_message(wheels_.estimate()));
      if (!source.publish_also(odometry_)) return false;
    }
    return true;
  }

  /// The true pose at the first ray of a scan, whose stamp [ns] that is.
  bool publish_truth(const World& world, steady_clock::time_point begin, std::int64_t stamp,
                     runtime::Source& source) {
    if (!parameters_.truth) return true;
    truth_.header().stamp(stamp);
    truth_.pose(topics::pose_message({pose_at(world, begin), Eigen::Matrix3d::Zero()}));
    return source.publish_also(truth_);
  }

 private:
  [[nodiscard]] Pose2 pose_at(const World& world, steady_clock::time_point time) const {
    const double elapsed = std::chrono::duration<double>(time - start_).count();
    return world.pose_at(parameters_.speed * std::max(elapsed, 0.0));
  }

  const SimulatedParameters& parameters_;
  steady_clock::time_point start_;
  WheelOdometry wheels_;
  RevolutionTimer timer_;  // a revolution is the time from one message to the next
  RevolutionTimer::Revolution next_{};
  msg::Odometry odometry_;
  msg::Pose truth_;
};

void publish_scans(SimulatedScanner scanner, const SimulatedParameters& parameters,
                   runtime::Source& source) {
  msg::Scan scan = declared_scan(parameters);
  SimulatedScan rays;
  const steady_clock::time_point start = steady_clock::now();
  RevolutionTimer timer(start, parameters.rate_hz);
  RobotOutput robot(parameters, start);
  for (std::int64_t count = 0; parameters.scans == 0 || count < parameters.scans; ++count) {
    const RevolutionTimer::Revolution revolution = timer.next(steady_clock::now());
    const double elapsed = std::chrono::duration<double>(revolution.begin - start).count();
    scanner.scan(parameters.speed * elapsed, parameters.speed, rays);
    scan.bearings() = rays.bearings;
    mount(parameters, scan.bearings());
    scan.ranges() = rays.ranges;
    scan.time_offsets() = rays.time_offsets;
    scan.duration(rays.time_offsets.back());
    if (!robot.publish_odometry(scanner.world(), revolution.end, source)) return;
    if (!source.wait_until(revolution.end)) return;
    const std::int64_t stamp = runtime::epoch_ns(revolution.begin);
    if (!robot.publish_truth(scanner.world(), revolution.begin, stamp, source)) return;
    scan.header().stamp(stamp);
    if (!source.publish(scan)) return;
  }
}

}  // namespace

std::function<void(runtime::Source&)> open_simulated(const ServiceConfig& config,
                                                     const std::filesystem::path& base_directory) {
  const auto parameters = make_parameters<SimulatedParameters>(config.parameters);
  SimulatedScanner scanner(load_world(parameters.environment, base_directory),
                           scanner_settings(parameters),
                           static_cast<std::uint64_t>(parameters.seed));
  return [parameters, scanner](runtime::Source& source) {
    publish_scans(scanner, parameters, source);
  };
}

}  // namespace quoin::sensor_bridge
