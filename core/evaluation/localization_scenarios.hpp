// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <utility>

#include "core/evaluation/mapping_quality.hpp"
#include "core/extraction/extraction.hpp"
#include "core/parameters/parameter.hpp"

namespace quoin {

/// What makes robots believe in a wrong pose.
enum class LocalizationScenario {
  corridor,        ///< whose ends are out of reach
  opening_door,    ///< of a room, into another one
  passing_people,  ///< to and fro before the robot
  parallel_walls,  ///< half a metre apart, of either face and seen together
  rooms_alike,     ///< side by side, and a corridor
  kidnapping,      ///< carried to another place, with another heading
  blinding,        ///< no returns for three seconds
};

template <>
struct EnumNames<LocalizationScenario> {
  static constexpr std::array<std::pair<LocalizationScenario, std::string_view>, 7> names{
      {{LocalizationScenario::corridor, "corridor"},
       {LocalizationScenario::opening_door, "opening_door"},
       {LocalizationScenario::passing_people, "passing_people"},
       {LocalizationScenario::parallel_walls, "parallel_walls"},
       {LocalizationScenario::rooms_alike, "rooms_alike"},
       {LocalizationScenario::kidnapping, "kidnapping"},
       {LocalizationScenario::blinding, "blinding"}}};
};

/// A robot that maps as it drives for a minute, at 0.5 m/s and ten scans a second.
struct ScenarioRun {
  LocalizationScenario scenario = LocalizationScenario::corridor;
  std::uint64_t seed = 1;  ///< of rooms, furniture, people and noise
  bool odometry = true;    ///< of wheels that slip by 2 %
  double duration = 60.0;  ///< [s]
};

struct ScenarioOutcome {
  std::size_t scans = 0, tracking = 0, ambiguous = 0, lost = 0;
  /// Scans while tracking whose error is beyond the four sigma of a Gaussian of 3 dimensions.
  std::size_t confident_wrong = 0;
  std::optional<double> first_wrong;  ///< [s] of them
  double largest_tracked = 0.0;       ///< [m] error while tracking
  /// [s] after the robot was carried away or blinded: the first scan that was lost, and the first
  /// one after it that was tracked, within four sigma.
  std::optional<double> lost_after, found_after;
};

[[nodiscard]] ScenarioOutcome run_scenario(const ScenarioRun& run, const Localize& localizer,
                                           Extraction& extraction);

}  // namespace quoin
