// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <idl/Scan.h>

#include "sensor_bridge/rplidar/protocol/configuration.hpp"
#include "sensor_bridge/rplidar/protocol/revolution.hpp"
#include "sensor_bridge/rplidar/service/parameters.hpp"

namespace quoin::sensor_bridge::rplidar {

/// A scan message without rays; for reuse from scan to scan.
[[nodiscard]] msg::Scan declared_scan(const RplidarParameters& parameters, const ScanMode& mode);

/// Fills the rays of a message. The device counts clockwise from its front, seen from above;
/// bearings are counter-clockwise from there (REP-103) in (-pi, pi], in the order of acquisition. A
/// sample without a return has the range +inf (REP-117). The stamp is left alone.
void fill_rays(const Revolution& revolution, const RplidarParameters& parameters, msg::Scan& scan);

}  // namespace quoin::sensor_bridge::rplidar
