// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <idl/Common.h>
#include <span>

#include "core/mapping/line_map.hpp"
#include "services/ros2/messages.hpp"

namespace quoin::ros2 {

/// A grid in which the cells that walls pass through are occupied and all others unknown: a map of
/// lines does not say what is free. It reaches a metre beyond the walls. `resolution` [m] of its
/// cells is doubled until there are at most 16 million. Walls that are no numbers are left out.
void fill_grid(std::span<const MapLine> walls, const msg::Header& header, double resolution,
               OccupancyGrid& out);

}  // namespace quoin::ros2
