// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/geometry/line.hpp"
#include "core/sensor/points.hpp"
#include "core/sensor/sensor_model.hpp"

namespace quoin {

/// The line of the CWLF paper's eq. (16) and (17) with their double sums over all pairs of points,
/// to compare its time with. The factor printed as the sum of the weights before both double sums
/// is its inverse. Same line as `arras_siegwart_line`; at least two different points, checks
/// nothing.
[[nodiscard]] Line arras_siegwart_literal(const PointsView& points, const SensorModel& sensor);

}  // namespace quoin
