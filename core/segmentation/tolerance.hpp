// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "core/geometry/line.hpp"
#include "core/segmentation/segment.hpp"
#include "core/sensor/points.hpp"

namespace quoin {

/// How far a point may be from the line it belongs to: `split_distance`, or `noise_factor` standard
/// deviations of the point's noise across the line where that is more. Noise along the ray counts
/// by the cosine of the incidence angle, noise of the bearing by its sine and the range.
struct Tolerance {
  double base = 0.0;     ///< [m^2] split_distance squared
  double range = 0.0;    ///< [m^2] noise_factor standard deviations of the range, squared
  double growth = 0.0;   ///< the same of what grows with the range, for each squared metre of it
  double bearing = 0.0;  ///< [rad^2] the same of the bearing
  double largest = 0.0;  ///< [m^2] of any point and line of the scan

  Tolerance() = default;
  /// For the points of one scan.
  Tolerance(const SegmentationParameters& parameters, const SensorModel& sensor,
            const PointsView& points);

  /// Whether noise counts for any point; if not, all tolerances are `base`.
  [[nodiscard]] bool raised() const { return largest > base; }

  /// [m^2] of a point `along` [m] the line from the foot of the perpendicular and `across` [m] from
  /// the sensor, whose ray meets the line at an angle of this `cosine` to its normal.
  [[nodiscard]] double squared(double cosine, double across, double along) const {
    const double noise =
        range * cosine * cosine + growth * across * across + bearing * along * along;
    return noise > base ? noise : base;
  }

  /// [m^2] of point `i` and a line with this unit normal.
  [[nodiscard]] double squared(const PointsView& points, std::size_t i, double normal_x,
                               double normal_y) const {
    return squared(points.cosine[i] * normal_x + points.sine[i] * normal_y,
                   points.x[i] * normal_x + points.y[i] * normal_y,
                   points.y[i] * normal_x - points.x[i] * normal_y);
  }
};

/// A tolerance is at least so many standard deviations (the default noise_factor); walls that are
/// not as straight as a line are given the same margin.
inline constexpr double deviations_in_tolerance = 4.0;

/// Whether point `i` is farther from the line than its tolerance.
[[nodiscard]] inline bool is_beyond(const NormalLine& line, const PointsView& points, std::size_t i,
                                    const Tolerance& tolerance) {
  const double distance = line.distance(points.x[i], points.y[i]);
  return distance * distance > tolerance.squared(points, i, line.normal_x, line.normal_y);
}

/// A point by its squared distance less its squared tolerance.
struct FarthestPoint {
  std::size_t index = 0;  ///< 0 when no point is beyond its tolerance
  double excess = 0.0;    ///< [m^2] positive beyond it

  [[nodiscard]] bool beyond() const { return excess > 0.0; }
};

/// Of the points, which are at least one, the one most beyond its tolerance.
[[nodiscard]] FarthestPoint farthest_from(const NormalLine& line, const PointsView& points,
                                          const Tolerance& tolerance);

/// Of the points of `chord`, which are at least one, the one most beyond its tolerance from the
/// chord between the first and the last of them; from the first point when the chord is shorter
/// than the distance from it. The index counts from the begin of the chord.
[[nodiscard]] FarthestPoint farthest_from_chord(const PointsView& points,
                                                const CoarsePoints& coarse, const Segment& chord,
                                                const Tolerance& tolerance);

}  // namespace quoin
