// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include <string>

#include "sensor_bridge/ros2_odometry/kind.hpp"
#include "services/ros2/poses.hpp"
#include "services/ros2/subscription.hpp"
#include "services/runtime/process/source.hpp"

using namespace quoin;

namespace {

void report_faults(const ros2::OdometryImport& odometry, runtime::Source& source) {
  for (std::size_t i = 0; i < ros2::odometry_fault_count; ++i) {
    const auto fault = static_cast<ros2::OdometryFault>(i);
    if (odometry.count(fault) == 0) continue;
    source.set_diagnostic("Odometry, " + std::string(ros2::text_of(fault)),
                          std::to_string(odometry.count(fault)) + " messages");
  }
}

void publish_odometry(const sensor_bridge::Ros2OdometryParameters& parameters,
                      const Deployment& deployment, const std::string& owner,
                      runtime::Source& source) {
  ros2::Subscription<ros2::Odometry> topic(
      source.participant(), deployment, owner, parameters.topic,
      parameters.reliability == sensor_bridge::Reliability::reliable);
  ros2::OdometryImport odometry;
  msg::Odometry out;
  std::uint64_t reported = 0;
  while (topic.wait(source)) {
    while (const ros2::Odometry* message = topic.take()) {
      const bool usable = odometry.convert(*message, topic.received(), out);
      if (odometry.faults() != reported) {
        reported = odometry.faults();
        report_faults(odometry, source);
      }
      if (usable && !source.publish_also(out)) return;
    }
  }
}

std::function<void(runtime::Source&)> open(const Deployment& deployment,
                                           const ServiceConfig& config) {
  const auto parameters = make_parameters<sensor_bridge::Ros2OdometryParameters>(config.parameters);
  ros2::check_topic(deployment, "topic", parameters.topic);
  return [parameters, &deployment, owner = label(config)](runtime::Source& source) {
    publish_odometry(parameters, deployment, owner, source);
  };
}

const runtime::Registration registration(runtime::source_component(
    sensor_bridge::ros2_odometry_kind(), runtime::DeploymentSourceFactory(open),
    runtime::port_types(runtime::Reads<>(), runtime::Writes<msg::Odometry>())));

}  // namespace
