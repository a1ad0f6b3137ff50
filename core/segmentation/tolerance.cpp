// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/segmentation/tolerance.hpp"

#include <algorithm>
#include <cmath>

#include "core/sensor/multiversion.hpp"

namespace quoin {
namespace {

/// The largest of all measure(i) for i < count, and its place when it is more than `limit`. Most
/// segments are straight: the maximum alone is found by vector instructions, and its place is
/// searched for when it matters.
template <class Measure>
[[gnu::always_inline]] inline FarthestPoint largest_of(std::size_t count, double limit,
                                                       const Measure& measure) {
  // Two maxima at a time: one would wait for itself.
  const std::size_t half = count / 2;
  double largest = measure(0);
  double other = largest;
  for (std::size_t i = 0; i < half; ++i) {
    const double value = measure(i);
    const double other_value = measure(half + i);
    largest = value > largest ? value : largest;
    other = other_value > other ? other_value : other;
  }
  if (count > 2 * half) {
    const double value = measure(count - 1);
    largest = value > largest ? value : largest;
  }
  largest = other > largest ? other : largest;
  if (largest <= limit) return {0, largest};

  // The first that is as large; instructions may round differently from loop to loop.
  const double almost = largest - 1e-12 * std::abs(largest);
  const auto none = static_cast<double>(count);
  double first = none;
  for (std::size_t i = 0; i < count; ++i) {
    const double place = measure(i) >= almost ? static_cast<double>(i) : none;
    first = place < first ? place : first;
  }
  return {static_cast<std::size_t>(first), largest};
}

/// Squared distances in units of the squared length of the normal, which need not be one.
QUOIN_MULTIVERSION
void farthest_fixed(const double* __restrict x, const double* __restrict y, std::size_t count,
                    double normal_x, double normal_y, double offset, double limit,
                    FarthestPoint& out) {
  out = largest_of(count, limit, [=](std::size_t i) {
    const double distance = normal_x * x[i] + normal_y * y[i] - offset;
    return distance * distance;
  });
}

QUOIN_MULTIVERSION
void farthest_raised(const double* __restrict inverse_range, const double* __restrict x,
                     const double* __restrict y, std::size_t count, NormalLine line,
                     Tolerance tolerance, FarthestPoint& out) {
  out = largest_of(count, 0.0, [=](std::size_t i) {
    const double normal = line.normal_x * x[i] + line.normal_y * y[i];
    const double along = line.normal_x * y[i] - line.normal_y * x[i];
    const double distance = normal - line.offset;
    return distance * distance - tolerance.squared(normal * inverse_range[i], along);
  });
}

QUOIN_MULTIVERSION
void farthest_from_first(const double* __restrict x, const double* __restrict y, std::size_t count,
                         double limit, FarthestPoint& out) {
  out = largest_of(count, limit, [=](std::size_t i) {
    return (x[i] - x[0]) * (x[i] - x[0]) + (y[i] - y[0]) * (y[i] - y[0]);
  });
}

QUOIN_MULTIVERSION
void find_largest(const double* values, std::size_t count, double& out) {
  double largest = 0.0;
  for (std::size_t i = 0; i < count; ++i) largest = values[i] > largest ? values[i] : largest;
  out = largest;
}

double square(double value) { return value * value; }

}  // namespace

Tolerance::Tolerance(const SegmentationParameters& parameters, const SensorModel& sensor,
                     const PointsView& points)
    : base(square(parameters.split_distance)),
      range(square(parameters.noise_factor * sensor.range_stddev)),
      bearing(square(parameters.noise_factor * sensor.bearing_stddev)) {
  double farthest = 0.0;
  find_largest(points.range.data(), points.size(), farthest);
  largest = std::max({base, range, bearing * farthest * farthest});
}

FarthestPoint farthest_from(const NormalLine& line, const PointsView& points,
                            const Tolerance& tolerance) {
  FarthestPoint farthest;
  if (tolerance.raised()) {
    farthest_raised(points.inverse_range.data(), points.x.data(), points.y.data(), points.size(),
                    line, tolerance, farthest);
    return farthest;
  }
  farthest_fixed(points.x.data(), points.y.data(), points.size(), line.normal_x, line.normal_y,
                 line.offset, tolerance.base, farthest);
  farthest.excess -= tolerance.base;
  return farthest;
}

FarthestPoint farthest_from_chord(const PointsView& points, const Tolerance& tolerance) {
  const double dx = points.x.back() - points.x.front();
  const double dy = points.y.back() - points.y.front();
  const double squared = dx * dx + dy * dy;
  FarthestPoint farthest;
  if (squared > 1e-18) {
    if (tolerance.raised()) {
      const double scale = 1.0 / std::sqrt(squared);
      NormalLine chord{-dy * scale, dx * scale, 0.0};
      chord.offset = chord.normal_x * points.x.front() + chord.normal_y * points.y.front();
      farthest = farthest_from(chord, points, tolerance);
    } else {
      // No root: the normal is as long as the chord.
      farthest_fixed(points.x.data(), points.y.data(), points.size(), -dy, dx,
                     dx * points.y.front() - dy * points.x.front(), squared * tolerance.base,
                     farthest);
      farthest.excess = farthest.excess / squared - tolerance.base;
    }
    if (farthest.excess + tolerance.largest <= squared) return farthest;
  }
  // The contour of a whole room begins and ends at one place: the direction of so short a chord is
  // noise, and all points of a wall that it happens to be parallel to are equally far from it.
  farthest_from_first(points.x.data(), points.y.data(), points.size(), tolerance.largest, farthest);
  farthest.excess -= tolerance.largest;
  return farthest;
}

}  // namespace quoin
