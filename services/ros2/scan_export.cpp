// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/ros2/scan_export.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/geometry/angle.hpp"
#include "services/ros2/rep117.hpp"

namespace quoin::ros2 {

namespace {

constexpr double whole = 2.0 * pi;
// [s] Of a sensor that stands still or turns once; longer pauses are no period.
constexpr double longest_period = 2.0;

/// In [0, 2 pi).
double positive(double angle) {
  const double rest = std::fmod(angle, whole);
  return rest < 0.0 ? rest + whole : rest;
}

}  // namespace

std::optional<std::size_t> ScanExport::Beams::nearest(double bearing, double& off) const {
  const double place = positive(bearing - first) / step;
  auto beam = static_cast<std::size_t>(std::llround(place));
  off = std::abs(place - static_cast<double>(beam)) * step;
  const auto turn = static_cast<double>(whole / step);
  if (beam >= count && turn - place <= 0.5) {  // just before the first
    off = (turn - place) * step;
    beam = 0;
  }
  if (beam >= count) return std::nullopt;
  return beam;
}

std::optional<ScanExport::Beams> ScanExport::beams_of(const msg::Scan& scan, std::size_t wanted) {
  const std::vector<float>& bearings = scan.bearings();
  if (bearings.size() < 2) return std::nullopt;
  double sweep = 0.0;  // [rad] from the first to the last ray, counter-clockwise
  for (std::size_t i = 1; i < bearings.size(); ++i) {
    const double step = normalized_angle(static_cast<double>(bearings[i]) - bearings[i - 1]);
    if (std::isfinite(step)) sweep += step;
  }
  const auto steps = static_cast<double>(bearings.size() - 1);
  const double spacing = std::abs(sweep) / steps;
  if (!(spacing > 0.0) || !std::isfinite(bearings.front())) return std::nullopt;
  Beams beams;
  beams.whole_turn = std::abs(sweep) + 1.5 * spacing > whole;
  const double start = static_cast<double>(bearings.front());
  if (beams.whole_turn) {
    beams.count = wanted > 0 ? wanted : static_cast<std::size_t>(std::llround(whole / spacing));
    beams.step = whole / static_cast<double>(beams.count);
    const double shift = std::fmod(positive(start + pi), beams.step);
    // -pi in single precision is just below.
    beams.first = shift > (1.0 - 1e-4) * beams.step ? -pi : -pi + shift;
  } else {
    beams.count = wanted > 1 ? wanted : bearings.size();
    beams.step = std::abs(sweep) / static_cast<double>(beams.count - 1);
    beams.first = normalized_angle(sweep > 0.0 ? start : start + sweep);
  }
  return beams;
}

bool ScanExport::convert(const msg::Scan& in, LaserScan& out) {
  if (!beams_) beams_ = beams_of(in, wanted_);
  if (!beams_) return false;
  const Beams& beams = *beams_;
  set_header(out.header(), in.header().stamp(), in.header().frame());
  out.angle_min(static_cast<float>(beams.first));
  out.angle_increment(static_cast<float>(beams.step));
  out.angle_max(
      static_cast<float>(beams.first + beams.step * static_cast<double>(beams.count - 1)));
  out.range_min(in.range_min());
  out.range_max(in.range_max());
  out.ranges().assign(beams.count, std::numeric_limits<float>::quiet_NaN());
  const std::size_t rays = std::min(in.bearings().size(), in.ranges().size());
  const bool qualities = rays > 0 && in.qualities().size() >= rays;
  out.intensities().assign(qualities ? beams.count : 0, 0.0F);
  off_.assign(beams.count, std::numeric_limits<double>::infinity());
  bool in_order = rays > 1;
  std::size_t last_beam = 0;
  for (std::size_t i = 0; i < rays; ++i) {
    double off = 0.0;
    const double bearing = static_cast<double>(in.bearings()[i]);
    const auto beam = std::isfinite(bearing) ? beams.nearest(bearing, off) : std::nullopt;
    if (!beam) continue;
    in_order = in_order && *beam >= last_beam && (i > 0 || *beam == 0);
    last_beam = *beam;
    if (off >= off_[*beam]) continue;
    off_[*beam] = off;
    out.ranges()[*beam] = rep117_range(in.ranges()[i], in.range_min(), in.range_max());
    if (qualities) out.intensities()[*beam] = in.qualities()[i];
  }
  const double period = static_cast<double>(in.header().stamp() - last_stamp_) * 1e-9;
  last_stamp_ = in.header().stamp();
  out.scan_time(period > 0.0 && period < longest_period ? static_cast<float>(period)
                                                        : in.duration());
  out.time_increment(in_order ? in.duration() /
                                    static_cast<float>(std::max<std::size_t>(beams.count, 2) - 1)
                              : 0.0F);
  return true;
}

}  // namespace quoin::ros2
