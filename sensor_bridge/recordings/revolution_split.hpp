// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstddef>
#include <numbers>

namespace quoin::sensor_bridge {

/// Finds where rays that come one after the other begin a new revolution: where they have gone
/// round once, or jumped back over a sector that the sensor does not see.
class RevolutionSplit {
 public:
  /// Whether the ray at `bearing` [rad] does not belong to the revolution so far.
  [[nodiscard]] bool begins_anew(double bearing) const {
    if (rays_ < fewest) return false;
    const double step = bearing - last_;
    const double way = swept_ < 0.0 ? -1.0 : 1.0;
    const double turned = unwound(step);
    if (std::abs(swept_ + turned) >= turn - 0.5 * typical()) return true;
    // A jump back: on over the seam of the circle, or to the start of a sector.
    return way * step < -0.5 * std::numbers::pi && std::abs(turned) > 5.0 * typical();
  }

  void add(double bearing) {
    if (rays_ > 0) swept_ += unwound(bearing - last_);
    last_ = bearing;
    ++rays_;
  }

 private:
  static constexpr double turn = 2.0 * std::numbers::pi;
  static constexpr std::size_t fewest = 3;

  /// Across the seam of the circle, where that is the shorter way.
  static double unwound(double step) { return std::remainder(step, turn); }
  [[nodiscard]] double typical() const { return std::abs(swept_) / static_cast<double>(rays_ - 1); }

  double last_ = 0.0;
  double swept_ = 0.0;  // [rad] positive counter-clockwise
  std::size_t rays_ = 0;
};

}  // namespace quoin::sensor_bridge
