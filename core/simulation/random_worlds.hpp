// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <utility>
#include <vector>

#include "core/parameters/parameter.hpp"
#include "core/simulation/world.hpp"

namespace quoin {

/// What worlds at random are like. The sensor rests in each, at least 0.4 m from everything.
enum class WorldStyle {
  room,  ///< 3 to 8 m: slanted walls, niches, doors that stand open, poles
  flat,  ///< 8 to 14 m: partitions, thin or thick, that end on walls or on each other, with
         ///< doorways
  hall,  ///< 12 to 30 m: square and round columns, niches, pilasters, a slanted wall
};

template <>
struct EnumNames<WorldStyle> {
  static constexpr std::array<std::pair<WorldStyle, std::string_view>, 3> names{
      {{WorldStyle::room, "room"}, {WorldStyle::flat, "flat"}, {WorldStyle::hall, "hall"}}};
};

/// Worlds of a style. Same seed, same worlds, and the first ones do not depend on `count`.
[[nodiscard]] std::vector<World> random_worlds(WorldStyle style, std::size_t count,
                                               std::uint64_t seed);

}  // namespace quoin
