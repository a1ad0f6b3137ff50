// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/simulation/world.hpp"

namespace quoin {

/// Rooms of 4 to 9 m with what a robot meets in them: cabinets and sofas along the walls, turned
/// tables and crates, table legs, bins, people's legs and heaps of small things, all placed at
/// random around a sensor that has at least half a metre of free space. Same seed, same rooms, and
/// the first ones do not depend on `count`.
[[nodiscard]] std::vector<World> cluttered_rooms(std::size_t count, std::uint64_t seed);

}  // namespace quoin
