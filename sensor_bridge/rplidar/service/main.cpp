// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "sensor_bridge/rplidar/service/kind.hpp"
#include "sensor_bridge/rplidar/service/rplidar_source.hpp"

using namespace quoin;

namespace {

const runtime::Registration registration(runtime::source_component(
    sensor_bridge::rplidar::rplidar_kind(), sensor_bridge::rplidar::open_rplidar));

}  // namespace
