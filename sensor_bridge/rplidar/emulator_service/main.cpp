// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "sensor_bridge/rplidar/emulator_service/emulator_service.hpp"
#include "sensor_bridge/rplidar/emulator_service/kind.hpp"

using namespace quoin;

namespace {

const runtime::Registration registration(runtime::activity_component(
    sensor_bridge::rplidar::rplidar_emulator_kind(), sensor_bridge::rplidar::open_emulator));

}  // namespace
