// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include <idl/Odometry.h>
#include <idl/Scan.h>

#include "sensor_bridge/replay/kind.hpp"
#include "sensor_bridge/replay/replay_source.hpp"

using namespace quoin;

namespace {

const runtime::Registration registration(runtime::source_component(
    sensor_bridge::replay_kind(), sensor_bridge::open_replay,
    runtime::port_types(runtime::Reads<>(), runtime::Writes<msg::Scan, msg::Odometry>())));

}  // namespace
