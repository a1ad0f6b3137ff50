// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "sensor_bridge/rplidar/service/scan_conversion.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>

#include "sensor_bridge/scan_declaration.hpp"

namespace quoin::sensor_bridge::rplidar {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double radians_per_q16 = 2.0 * pi / full_circle_q16;

/// (-pi, pi], of the angle that the device reports, which counts clockwise.
float bearing_of(double angle_q16, const Mounting& mounting) {
  const double turned = angle_q16 * radians_per_q16;  // [0, 2 pi)
  return mounted(mounting, static_cast<float>(turned >= pi ? 2.0 * pi - turned : -turned));
}

float range_of(std::uint32_t distance_q2) {
  constexpr float metres_per_q2 = 1.0F / 4000.0F;
  return distance_q2 == 0 ? std::numeric_limits<float>::infinity()
                          : static_cast<float>(distance_q2) * metres_per_q2;
}

float quality_of(std::uint8_t quality) { return static_cast<float>(quality) / 255.0F; }

void resize(msg::Scan& scan, std::size_t count) {
  scan.bearings().resize(count);
  scan.ranges().resize(count);
  scan.qualities().resize(count);
  scan.time_offsets().resize(count);
}

void copy_samples(const Revolution& revolution, const Mounting& mounting, msg::Scan& scan) {
  const std::size_t count = revolution.angle_q16.size();
  resize(scan, count);
  for (std::size_t i = 0; i < count; ++i) {
    scan.bearings()[i] = bearing_of(revolution.angle_q16[i], mounting);
    scan.ranges()[i] = range_of(revolution.distance_q2[i]);
    scan.qualities()[i] = quality_of(revolution.quality[i]);
  }
  std::ranges::copy(revolution.time_offset, scan.time_offsets().begin());
}

/// The nearest of the samples of a bin stands for all: what is in the way matters most.
void sort_into_bins(const Revolution& revolution, std::size_t bins, const Mounting& mounting,
                    msg::Scan& scan) {
  resize(scan, bins);
  const double width = static_cast<double>(full_circle_q16) / static_cast<double>(bins);
  const float duration = revolution.time_offset.empty() ? 0.0F : revolution.time_offset.back();
  for (std::size_t bin = 0; bin < bins; ++bin) {
    scan.bearings()[bin] = bearing_of(width * static_cast<double>(bin), mounting);
    scan.ranges()[bin] = std::numeric_limits<float>::quiet_NaN();
    scan.qualities()[bin] = 0.0F;
    scan.time_offsets()[bin] = duration * static_cast<float>(bin) / static_cast<float>(bins);
  }
  for (std::size_t i = 0; i < revolution.angle_q16.size(); ++i) {
    const auto nearest = static_cast<std::size_t>(std::lround(revolution.angle_q16[i] / width));
    const std::size_t bin = nearest == bins ? 0 : nearest;
    const float range = range_of(revolution.distance_q2[i]);
    if (range >= scan.ranges()[bin]) continue;
    scan.ranges()[bin] = range;
    scan.qualities()[bin] = quality_of(revolution.quality[i]);
    if (nearest != bins) scan.time_offsets()[bin] = revolution.time_offset[i];
  }
}

}  // namespace

msg::Scan declared_scan(const RplidarParameters& parameters, const ScanMode& mode) {
  msg::Scan scan = sensor_bridge::declared_scan(parameters);
  if (parameters.range_max == 0.0) scan.range_max(static_cast<float>(mode.range_max));
  return scan;
}

void fill_rays(const Revolution& revolution, const RplidarParameters& parameters, msg::Scan& scan) {
  if (parameters.bins == 0) {
    copy_samples(revolution, parameters, scan);
  } else {
    sort_into_bins(revolution, static_cast<std::size_t>(parameters.bins), parameters, scan);
  }
  scan.duration(scan.time_offsets().empty() ? 0.0F : scan.time_offsets().back());
}

}  // namespace quoin::sensor_bridge::rplidar
