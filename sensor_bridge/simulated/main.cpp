// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include <idl/Odometry.h>
#include <idl/Pose.h>
#include <idl/Scan.h>

#include "sensor_bridge/simulated/kind.hpp"
#include "sensor_bridge/simulated/simulated_source.hpp"

using namespace quoin;

namespace {

const runtime::Registration registration(runtime::source_component(
    sensor_bridge::simulated_kind(), sensor_bridge::open_simulated,
    runtime::port_types(runtime::Reads<>(),
                        runtime::Writes<msg::Scan, msg::Odometry, msg::Pose>())));

}  // namespace
