// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "sensor_bridge/ros2_scan/kind.hpp"
#include "sensor_bridge/ros2_scan/scan_source.hpp"

using namespace quoin;

namespace {

const runtime::Registration registration(
    runtime::source_component(sensor_bridge::ros2_scan_kind(),
                              runtime::DeploymentSourceFactory(sensor_bridge::open_ros2_scan)));

}  // namespace
