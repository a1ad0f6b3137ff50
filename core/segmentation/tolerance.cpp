// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/segmentation/tolerance.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/sensor/multiversion.hpp"

namespace quoin {
namespace {

/// The largest of all measure(i) for i < count, and its index when it is more than `limit`. Most
/// segments are straight: the maximum alone is found by vector instructions, and its index is
/// searched for when it matters.
template <class Number, class Measure>
[[gnu::always_inline]] inline FarthestPoint largest_of(std::size_t count, Number limit,
                                                       const Measure& measure) {
  const auto end = static_cast<int>(count);
  Number largest = measure(0);
  for (int i = 0; i < end; ++i) {
    const Number value = measure(i);
    largest = value > largest ? value : largest;
  }
  if (largest <= limit) return {0, static_cast<double>(largest)};

  // The first that is as large; instructions may round differently from loop to loop.
  const Number almost = largest - 10 * std::numeric_limits<Number>::epsilon() * std::abs(largest);
  const auto none = static_cast<Number>(end);
  Number first = none;
  for (int i = 0; i < end; ++i) {
    const Number index = measure(i) >= almost ? static_cast<Number>(i) : none;
    first = index < first ? index : first;
  }
  return {static_cast<std::size_t>(first), static_cast<double>(largest)};
}

/// Squared distances in units of the squared length of the normal, which need not be one.
template <class Number>
[[gnu::always_inline]] inline FarthestPoint farthest_fixed(const Number* __restrict x,
                                                           const Number* __restrict y,
                                                           std::size_t count, Number normal_x,
                                                           Number normal_y, Number offset,
                                                           Number limit) {
  return largest_of(count, limit, [=](int i) {
    const Number distance = normal_x * x[i] + normal_y * y[i] - offset;
    return distance * distance;
  });
}

QUOIN_MULTIVERSION
void farthest_fixed_double(const double* x, const double* y, std::size_t count, double normal_x,
                           double normal_y, double offset, double limit, FarthestPoint& out) {
  out = farthest_fixed(x, y, count, normal_x, normal_y, offset, limit);
}

QUOIN_MULTIVERSION
void farthest_fixed_float(const float* x, const float* y, std::size_t count, float normal_x,
                          float normal_y, float offset, float limit, FarthestPoint& out) {
  out = farthest_fixed(x, y, count, normal_x, normal_y, offset, limit);
}

QUOIN_MULTIVERSION
void farthest_raised(const double* __restrict inverse_range, const double* __restrict x,
                     const double* __restrict y, std::size_t count, NormalLine line,
                     Tolerance tolerance, FarthestPoint& out) {
  out = largest_of(count, 0.0, [=](int i) {
    const double normal = line.normal_x * x[i] + line.normal_y * y[i];
    const double along = line.normal_x * y[i] - line.normal_y * x[i];
    const double distance = normal - line.offset;
    return distance * distance - tolerance.squared(normal * inverse_range[i], normal, along);
  });
}

QUOIN_MULTIVERSION
void farthest_from_first(const double* __restrict x, const double* __restrict y, std::size_t count,
                         double limit, FarthestPoint& out) {
  out = largest_of(count, limit, [=](int i) {
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
      growth(square(parameters.noise_factor * sensor.range_stddev_per_metre)),
      bearing(square(parameters.noise_factor * sensor.bearing_stddev)) {
  double farthest = 0.0;
  find_largest(points.range.data(), points.size(), farthest);
  largest = std::max({base, range + growth * farthest * farthest, bearing * farthest * farthest});
}

FarthestPoint farthest_from(const NormalLine& line, const PointsView& points,
                            const Tolerance& tolerance) {
  FarthestPoint farthest;
  if (tolerance.raised()) {
    farthest_raised(points.inverse_range.data(), points.x.data(), points.y.data(), points.size(),
                    line, tolerance, farthest);
    return farthest;
  }
  farthest_fixed_double(points.x.data(), points.y.data(), points.size(), line.normal_x,
                        line.normal_y, line.offset, tolerance.base, farthest);
  farthest.excess -= tolerance.base;
  return farthest;
}

FarthestPoint farthest_from_chord(const PointsView& points, const CoarsePoints& coarse,
                                  const Segment& chord, const Tolerance& tolerance) {
  const std::size_t first = chord.begin;
  const std::size_t last = chord.end - 1;
  const float dx = coarse.x[last] - coarse.x[first];
  const float dy = coarse.y[last] - coarse.y[first];
  const double squared = square(static_cast<double>(dx)) + square(static_cast<double>(dy));
  FarthestPoint farthest;
  if (squared > 1e-18) {
    if (tolerance.raised()) {
      const double scale = 1.0 / std::sqrt(squared);
      NormalLine line{static_cast<double>(-dy) * scale, static_cast<double>(dx) * scale, 0.0};
      line.offset = line.normal_x * points.x[first] + line.normal_y * points.y[first];
      farthest = farthest_from(line, points.subview(chord.begin, chord.end), tolerance);
    } else {
      // No root: the normal is as long as the chord.
      farthest_fixed_float(&coarse.x[first], &coarse.y[first], chord.size(), -dy, dx,
                           dx * coarse.y[first] - dy * coarse.x[first],
                           static_cast<float>(squared * tolerance.base), farthest);
      farthest.excess = farthest.excess / squared - tolerance.base;
    }
    if (farthest.excess + tolerance.largest <= squared) return farthest;
  }
  // The contour of a whole room begins and ends at one point: the direction of so short a chord is
  // noise, and all points of a wall that it happens to be parallel to are equally far from it.
  farthest_from_first(&points.x[first], &points.y[first], chord.size(), tolerance.largest,
                      farthest);
  farthest.excess -= tolerance.largest;
  return farthest;
}

}  // namespace quoin
