// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string_view>
#include <tuple>
#include <utility>

#include "core/parameters/parameter.hpp"

namespace quoin {

/// What says how the sensor moves during a scan.
enum class DeskewBy {
  odometry,
  pose,
  off,
};

template <>
struct EnumNames<DeskewBy> {
  static constexpr std::array<std::pair<DeskewBy, std::string_view>, 3> names{
      {{DeskewBy::odometry, "odometry"}, {DeskewBy::pose, "pose"}, {DeskewBy::off, "off"}}};
};

/// Of kind deskewing.
struct DeskewingParameters {
  DeskewBy deskew = DeskewBy::odometry;
  double sweep = 0.0;         ///< [s]
  double mounting_x = 0.0;    ///< [m]
  double mounting_y = 0.0;    ///< [m]
  double mounting_yaw = 0.0;  ///< [rad]

  static constexpr auto fields() {
    using P = DeskewingParameters;
    return std::tuple{
        field(&P::deskew, "deskew",
              "what says how the sensor moves: the port odometry or the port pose; off leaves "
              "scans as they are"),
        field(
            &P::sweep, "sweep", "s", 0.0, 10.0,
            "time from the first to the last ray of scans that do not say when each ray was cast; "
            "0: those are taken to be cast at one moment"),
        field(&P::mounting_x, "mounting_x", "m", -100.0, 100.0,
              "place of the sensor on the robot, forward of its base"),
        field(&P::mounting_y, "mounting_y", "m", -100.0, 100.0, "to the left of it"),
        field(&P::mounting_yaw, "mounting_yaw", "rad", -6.2832, 6.2832,
              "direction of the sensor's x axis on the robot")};
  }
};

}  // namespace quoin
