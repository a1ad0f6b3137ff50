// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/ros2/scan_import.hpp"

#include <algorithm>
#include <cmath>

#include "services/ros2/rep117.hpp"

namespace quoin::ros2 {

namespace {

// [s] From the first to the last ray of any 2D LiDAR.
constexpr double longest_scan = 10.0;
// [ns] A stamp is made on this robot or on one whose clock is nearly right; simulated time begins
// at 0.
constexpr std::int64_t another_clock = 3600 * nanoseconds_a_second;
// Steps between angle_max and the last ray: many drivers put it one step beyond.
constexpr double angle_max_tolerance = 1.5;

std::string_view without_slash(std::string_view frame) {
  if (frame.starts_with('/')) frame.remove_prefix(1);  // of ROS 1
  return frame;
}

}  // namespace

std::string_view text_of(ScanFault fault) {
  switch (fault) {
    case ScanFault::too_many_rays:
      return "more than 100000 ranges: left out";
    case ScanFault::no_angle_min:
      return "angle_min is no number: left out";
    case ScanFault::no_increment:
      return "angle_increment is 0 or no number, and angle_max gives none: left out";
    case ScanFault::other_frame:
      return "frame_id is another than the deployment names: left out";
    case ScanFault::no_rays:
      return "no ranges";
    case ScanFault::increment_from_angle_max:
      return "angle_increment is 0 or no number: taken from angle_max";
    case ScanFault::increment_against_angle_max:
      return "angle_increment has the wrong sign for angle_max: angle_increment counts";
    case ScanFault::angle_max_elsewhere:
      return "angle_max does not fit the number of ranges: angle_increment counts";
    case ScanFault::ray_count_changed:
      return "the number of ranges has changed";
    case ScanFault::intensities_of_other_length:
      return "intensities and ranges differ in length";
    case ScanFault::no_range_limits:
      return "range_min and range_max leave no range: those of the deployment count";
    case ScanFault::no_time_increment:
      return "time_increment is negative, no number or beyond 10 s a scan: rays have no times";
    case ScanFault::stamp_zero:
      return "the stamp is 0: the time of arrival is taken";
    case ScanFault::stamp_of_another_clock:
      return "the stamp is more than an hour off (simulated time?): kept";
    case ScanFault::stamp_not_later:
      return "the stamp is not later than that of the scan before";
    case ScanFault::no_frame:
      return "no frame_id; name one by the parameter frame";
    case ScanFault::frame_changed:
      return "frame_id has changed";
  }
  return "";
}

bool ScanImport::note(ScanFault fault) {
  Tally& tally = tallies_[static_cast<std::size_t>(fault)];
  ++tally.count;
  tally.last = taken_ - 1;
  ++faults_;
  return !fatal(fault);
}

/// [rad] From one ray to the next; 0 when there is none.
double ScanImport::increment_of(const LaserScan& in) {
  const auto steps = static_cast<double>(in.ranges().size()) - 1.0;
  const double span = static_cast<double>(in.angle_max()) - static_cast<double>(in.angle_min());
  const double increment = static_cast<double>(in.angle_increment());
  if (!std::isfinite(increment) || increment == 0.0) {
    if (steps < 1.0 || !std::isfinite(span) || span == 0.0) return 0.0;
    (void)note(ScanFault::increment_from_angle_max);
    return span / steps;
  }
  if (std::isfinite(span) && span * increment < 0.0 && std::abs(span) > std::abs(increment)) {
    (void)note(ScanFault::increment_against_angle_max);
  } else if (!(std::abs(span - steps * increment) <= angle_max_tolerance * std::abs(increment))) {
    (void)note(ScanFault::angle_max_elsewhere);
  }
  return increment;
}

void ScanImport::set_times(const LaserScan& in, std::int64_t received, msg::Scan& out) {
  const auto steps = static_cast<double>(std::max<std::size_t>(in.ranges().size(), 1) - 1);
  const double step = static_cast<double>(in.time_increment());
  const bool usable = step >= 0.0 && step * steps <= longest_scan;
  if (!usable) (void)note(ScanFault::no_time_increment);
  const double duration = usable ? step * steps : 0.0;
  out.duration(static_cast<float>(duration));
  out.time_offsets().clear();
  for (std::size_t i = 0; duration > 0.0 && i < in.ranges().size(); ++i) {
    out.time_offsets().push_back(static_cast<float>(step * static_cast<double>(i)));
  }
  std::int64_t stamp = nanoseconds(in.header().stamp());
  double behind = 0.0;  // [s] the stamp behind the first ray
  if (stamp == 0) {
    (void)note(ScanFault::stamp_zero);
    stamp = received;
    behind = duration;
  } else if (std::abs(stamp - received) > another_clock) {
    (void)note(ScanFault::stamp_of_another_clock);
  }
  if (options_.stamped == StampedRay::last) {
    const auto sweep = static_cast<double>(in.scan_time());
    behind = duration > 0.0 || !(sweep > 0.0 && sweep <= longest_scan) ? duration : sweep;
  }
  stamp -= std::llround(behind * 1e9);
  if (stamp_ != 0 && stamp <= stamp_) (void)note(ScanFault::stamp_not_later);
  stamp_ = stamp;
  out.header().stamp(stamp);
}

void ScanImport::set_ranges(const LaserScan& in, msg::Scan& out) {
  float range_min = static_cast<float>(options_.range_min);
  float range_max = static_cast<float>(options_.range_max);
  if (in.range_max() > std::max(in.range_min(), 0.0F)) {
    range_min = std::max(range_min, in.range_min());
    range_max = std::min(range_max, in.range_max());
  } else {
    (void)note(ScanFault::no_range_limits);
  }
  out.range_min(range_min);
  out.range_max(range_max);
  out.ranges().resize(in.ranges().size());
  std::ranges::transform(in.ranges(), out.ranges().begin(),
                         [&](float range) { return rep117_range(range, range_min, range_max); });
}

bool ScanImport::convert(const LaserScan& in, std::int64_t received, msg::Scan& out) {
  const std::size_t rays = in.ranges().size();
  ++taken_;
  ++left_out_;  // until it turns out to be of use
  const std::string_view frame = without_slash(in.header().frame_id());
  if (!options_.frame.empty() && frame != options_.frame && !frame.empty()) {
    return note(ScanFault::other_frame);
  }
  if (rays > most_rays) return note(ScanFault::too_many_rays);
  if (!std::isfinite(in.angle_min())) return note(ScanFault::no_angle_min);
  const double increment = rays > 0 ? increment_of(in) : 1.0;
  if (increment == 0.0 && rays > 1) return note(ScanFault::no_increment);
  --left_out_;

  if (rays == 0) (void)note(ScanFault::no_rays);
  if (taken_ - left_out_ > 1 && rays != rays_) (void)note(ScanFault::ray_count_changed);
  rays_ = rays;
  if (!in.intensities().empty() && in.intensities().size() != rays) {
    (void)note(ScanFault::intensities_of_other_length);
  }
  if (frame.empty() && options_.frame.empty()) (void)note(ScanFault::no_frame);
  if (taken_ - left_out_ > 1 && frame != frame_) (void)note(ScanFault::frame_changed);
  frame_ = frame;

  out.header().frame(options_.frame.empty() ? frame_ : options_.frame);
  out.bearings().resize(rays);
  for (std::size_t i = 0; i < rays; ++i) {
    out.bearings()[i] = static_cast<float>(static_cast<double>(in.angle_min()) +
                                           increment * static_cast<double>(i));
  }
  out.qualities().clear();
  set_ranges(in, out);
  set_times(in, received, out);
  return true;
}

}  // namespace quoin::ros2
