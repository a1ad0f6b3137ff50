// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "sensor_bridge/ros2_scan/scan_source.hpp"

#include <string>

#include "sensor_bridge/range_limits.hpp"
#include "sensor_bridge/ros2_scan/parameters.hpp"
#include "sensor_bridge/scan_declaration.hpp"
#include "services/ros2/messages.hpp"
#include "services/ros2/scan_import.hpp"
#include "services/ros2/subscription.hpp"
#include "services/ros2/topics.hpp"

namespace quoin::sensor_bridge {
namespace {

/// Names each fault of the scans with its count, once a new one has been found.
class FaultReport {
 public:
  void update(const ros2::ScanImport& scans, runtime::Source& source) {
    if (scans.faults() == reported_) return;
    reported_ = scans.faults();
    for (std::size_t i = 0; i < ros2::scan_fault_count; ++i) {
      const auto fault = static_cast<ros2::ScanFault>(i);
      const ros2::ScanImport::Tally& tally = scans.tally(fault);
      if (tally.count == 0) continue;
      const std::string text(ros2::text_of(fault));
      if (tally.count == 1 && tally.last + 1 == scans.taken()) {
        source.warn("LaserScan " + std::to_string(tally.last) + ": " + text);
      }
      source.set_diagnostic("LaserScan, " + text, std::to_string(tally.count) + " scans, last " +
                                                      std::to_string(tally.last));
    }
  }

 private:
  std::uint64_t reported_ = 0;
};

void publish_scans(const Ros2ScanParameters& parameters, const Deployment& deployment,
                   const std::string& owner, runtime::Source& source) {
  msg::Scan scan = declared_scan(parameters);
  ros2::ScanImport scans({.stamped = parameters.stamp == StampOf::last_ray
                                         ? ros2::StampedRay::last
                                         : ros2::StampedRay::first,
                          .frame = parameters.frame,
                          .range_min = parameters.range_min,
                          .range_max = parameters.range_max});
  FaultReport faults;
  ros2::Subscription<ros2::LaserScan> topic(source.participant(), deployment, owner,
                                            parameters.topic,
                                            parameters.reliability == Reliability::reliable);
  while (topic.wait(source)) {
    while (const ros2::LaserScan* message = topic.take()) {
      const bool usable = scans.convert(*message, topic.received(), scan);
      faults.update(scans, source);
      if (!usable) continue;
      mount(parameters, scan.bearings());
      if (!source.publish(scan)) return;
    }
  }
}

}  // namespace

std::function<void(runtime::Source&)> open_ros2_scan(const Deployment& deployment,
                                                     const ServiceConfig& config) {
  const auto parameters = make_parameters<Ros2ScanParameters>(config.parameters);
  check_range_limits(parameters);
  ros2::check_topic(deployment, "topic", parameters.topic);
  return [parameters, &deployment, owner = label(config)](runtime::Source& source) {
    publish_scans(parameters, deployment, owner, source);
  };
}

}  // namespace quoin::sensor_bridge
