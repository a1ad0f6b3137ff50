// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "sensor_bridge/recordings/scan_geometry.hpp"

#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>

namespace quoin::sensor_bridge {

namespace {

// A scan of fewer rays is of no sensor that could be told by their number.
constexpr std::size_t fewest_to_judge = 16;

/// Steps that a SICK LMS can be set to.
bool is_sick_step(double step) {
  for (const double known : {1.0, 0.5, 0.25}) {
    if (std::abs(step - known * degree) < 1e-3 * known * degree) return true;
  }
  return false;
}

std::string degrees(double radians) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.4g deg", radians / degree);
  return text.data();
}

double positive(double angle) {
  const double rest = std::fmod(angle, 2.0 * std::numbers::pi);
  return rest < 0.0 ? rest + 2.0 * std::numbers::pi : rest;
}

}  // namespace

std::string fill_bearings(std::size_t count, const ScanGeometry& geometry,
                          std::vector<float>& bearings) {
  const bool declared = geometry.field_of_view > 0.0;
  const double field_of_view = declared ? geometry.field_of_view : std::numbers::pi;
  const auto rays = static_cast<double>(count);
  const bool half_open = count % 2 == 0 && is_sick_step(field_of_view / rays);
  const double steps = half_open || count < 2 ? rays : rays - 1.0;
  const double step = count == 0 ? 0.0 : field_of_view / steps;
  bearings.clear();
  for (std::size_t i = 0; i < count; ++i) {
    bearings.push_back(static_cast<float>(-0.5 * field_of_view + static_cast<double>(i) * step));
  }
  if (geometry.angle_step != 0.0 || count < fewest_to_judge || is_sick_step(step)) return "";
  const std::string taken = std::to_string(count) + " rays over " +
                            (declared ? "" : "the default of ") + degrees(field_of_view) +
                            " are a step of " + degrees(step);
  if (!declared) {
    return taken +
           ", which no SICK LMS has; walls will be bent unless that is right: set "
           "field_of_view, or start_angle and angle_step";
  }
  return taken + " with a ray at both ends; if that is not right, set start_angle and angle_step";
}

void apply_geometry(const ScanGeometry& geometry, RecordedScan& scan) {
  const bool mirrored = geometry.clockwise != geometry.inverted;
  for (std::size_t i = 0; i < scan.bearings.size(); ++i) {
    double bearing = scan.bearings[i];
    if (geometry.angle_step != 0.0) {
      bearing = geometry.start_angle + static_cast<double>(i) * geometry.angle_step;
    }
    if (mirrored) bearing = -bearing;
    if (mirrored || geometry.angle_step != 0.0 || geometry.angle_offset != 0.0) {
      scan.bearings[i] = static_cast<float>(bearing + geometry.angle_offset);
    }
    if (geometry.leave_out_from == geometry.leave_out_to) continue;
    const double width = positive(geometry.leave_out_to - geometry.leave_out_from);
    if (positive(scan.bearings[i] - geometry.leave_out_from) <= width) {
      scan.ranges[i] = std::numeric_limits<float>::quiet_NaN();
    }
  }
}

}  // namespace quoin::sensor_bridge
