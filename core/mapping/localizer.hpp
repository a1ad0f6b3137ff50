// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "core/corners/corner_finder.hpp"
#include "core/geometry/line.hpp"
#include "core/mapping/line_map.hpp"
#include "core/mapping/motion.hpp"
#include "core/parameters/parameter.hpp"

namespace quoin {

/// What is known of a pose.
enum class LocalizationStatus {
  tracking,   ///< the pose is known within its covariance
  ambiguous,  ///< one direction is not determined, or several poses explain the scan
  lost,       ///< the scan does not fit the map where the robot should be
};

template <>
struct EnumNames<LocalizationStatus> {
  static constexpr std::array<std::pair<LocalizationStatus, std::string_view>, 3> names{
      {{LocalizationStatus::tracking, "tracking"},
       {LocalizationStatus::ambiguous, "ambiguous"},
       {LocalizationStatus::lost, "lost"}}};
};

/// The features of one scan, in the frame of the sensor.
struct LocalizationInput {
  double stamp = 0.0;                  ///< [s] of the scan; stamps ascend
  std::span<const LineSegment> lines;  ///< [m]
  std::span<const Corner> corners;     ///< of these lines; may be empty
  /// Motion of the sensor since the previous scan, in its frame then; without it the velocity is
  /// taken to be constant.
  std::optional<PoseEstimate> motion;
  bool wants_map = false;  ///< fill Localization::map
};

/// Where the sensor is, in the frame of the map, whose origin is the first pose.
struct Localization {
  PoseEstimate pose;
  LocalizationStatus status = LocalizationStatus::tracking;
  /// [rad] in the frame of the map: the direction in which the walls say nothing of the position.
  std::optional<double> weak_direction;
  std::size_t matched = 0;   ///< lines of the scan that are in the map
  std::vector<MapLine> map;  ///< empty unless it was wanted
};

/// Localizes one scan after the other, and maps what is new. The result is overwritten and keeps
/// its memory.
using Localizer = std::function<void(const LocalizationInput&, Localization&)>;

}  // namespace quoin
