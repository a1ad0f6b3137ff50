// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

#include "services/runtime/process/source.hpp"

namespace quoin::sensor_bridge {

/// The body that publishes each LaserScan of a ROS 2 topic as a scan, until it is stopped. Throws
/// ParameterError, and std::invalid_argument for a deployment that ROS 2 cannot take part in. What
/// is wrong with the messages is in the heartbeat, each fault with how often it was found.
[[nodiscard]] std::function<void(runtime::Source&)> open_ros2_scan(const Deployment& deployment,
                                                                   const ServiceConfig& config);

}  // namespace quoin::sensor_bridge
