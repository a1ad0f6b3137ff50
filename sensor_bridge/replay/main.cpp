// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include <idl/Circles.h>
#include <idl/Corners.h>
#include <idl/LineMap.h>
#include <idl/Lines.h>
#include <idl/Odometry.h>
#include <idl/Pose.h>
#include <idl/Scan.h>
#include <idl/Segments.h>

#include "sensor_bridge/replay/kind.hpp"
#include "sensor_bridge/replay/replay_source.hpp"

using namespace quoin;

namespace {

const runtime::Registration registration(runtime::source_component(
    sensor_bridge::replay_kind(), sensor_bridge::open_replay,
    runtime::port_types(runtime::Reads<>(),
                        runtime::Writes<msg::Scan, msg::Odometry, msg::Segments, msg::Lines,
                                        msg::Corners, msg::Circles, msg::Pose, msg::LineMap>())));

}  // namespace
