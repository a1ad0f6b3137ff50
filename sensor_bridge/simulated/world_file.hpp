// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>

#include "core/simulation/world.hpp"

namespace quoin::sensor_bridge {

/// A world that cannot be had: "file:line:column: what; what to do", or which name is unknown.
class WorldError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A world from YAML text; `file` is what messages name. Lengths in metres, angles in radians:
///
///     name: corridor               # the file's name when left out
///     description: 20 m, one door  # optional
///     walls:
///       - {points: [[0, 0], [20, 0], [20, 2]], closed: false}
///     pillars:
///       - {center: [3, 1], radius: 0.1}
///     path:                        # way points x, y, theta; a resting sensor stays at the first
///       - [1, 1, 0]
///
/// Throws WorldError for the first thing that is wrong.
[[nodiscard]] World parse_world(const std::string& text, const std::filesystem::path& file);

/// The built-in world of that name, or the world in the file of that path, relative to
/// `base_directory`. Throws WorldError.
[[nodiscard]] World load_world(const std::string& environment,
                               const std::filesystem::path& base_directory);

}  // namespace quoin::sensor_bridge
