// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/segmentation/tolerance.hpp"

#include <algorithm>
#include <cmath>

#include "core/sensor/multiversion.hpp"

namespace quoin {
namespace {

/// Largest measure(i) for i < count, and its place when it is more than 1. The maximum of each
/// block is found by vector instructions; only the best block is searched, and most segments are
/// straight and not searched at all.
template <class Measure>
[[gnu::always_inline]] inline FarthestPoint largest_of(std::size_t count, const Measure& measure) {
  constexpr std::size_t block = 32;
  double largest = 0.0;
  std::size_t best_begin = 0;
  std::size_t begin = 0;
  for (; begin + block <= count; begin += block) {
    double largest_here = 0.0;
    for (std::size_t i = begin; i < begin + block; ++i) {
      const double value = measure(i);
      largest_here = value > largest_here ? value : largest_here;
    }
    best_begin = largest_here > largest ? begin : best_begin;
    largest = largest_here > largest ? largest_here : largest;
  }
  double largest_here = 0.0;
  for (std::size_t i = begin; i < count; ++i) {
    const double value = measure(i);
    largest_here = value > largest_here ? value : largest_here;
  }
  best_begin = largest_here > largest ? begin : best_begin;
  largest = largest_here > largest ? largest_here : largest;
  if (largest <= 1.0) return {0, largest};

  // Vector and scalar instructions may round differently; the last point of the block is the rest.
  const double almost = largest * (1.0 - 1e-12);
  const std::size_t end = best_begin + block < count ? best_begin + block : count;
  std::size_t index = best_begin;
  while (index + 1 < end && measure(index) < almost) ++index;
  return {index, largest};
}

QUOIN_MULTIVERSION
void farthest_fixed(const double* __restrict x, const double* __restrict y, std::size_t count,
                    NormalLine line, double scale, FarthestPoint& out) {
  const double normal_x = line.normal_x * scale;
  const double normal_y = line.normal_y * scale;
  const double offset = line.offset * scale;
  out = largest_of(count, [=](std::size_t i) {
    const double distance = normal_x * x[i] + normal_y * y[i] - offset;
    return distance * distance;
  });
}

QUOIN_MULTIVERSION
void farthest_raised(const double* __restrict range, const double* __restrict cosine,
                     const double* __restrict sine, const double* __restrict x,
                     const double* __restrict y, std::size_t count, NormalLine line,
                     Tolerance tolerance, FarthestPoint& out) {
  out = largest_of(count, [=](std::size_t i) {
    const double distance = line.normal_x * x[i] + line.normal_y * y[i] - line.offset;
    const double cos_phi = cosine[i] * line.normal_x + sine[i] * line.normal_y;
    const double sin_phi = sine[i] * line.normal_x - cosine[i] * line.normal_y;
    return distance * distance / tolerance.squared(range[i], cos_phi, sin_phi);
  });
}

QUOIN_MULTIVERSION
void farthest_from_first(const double* __restrict x, const double* __restrict y, std::size_t count,
                         double scale, FarthestPoint& out) {
  out = largest_of(count, [=](std::size_t i) {
    return scale * ((x[i] - x[0]) * (x[i] - x[0]) + (y[i] - y[0]) * (y[i] - y[0]));
  });
}

double square(double value) { return value * value; }

}  // namespace

Tolerance::Tolerance(const SegmentationParameters& parameters, const SensorModel& sensor,
                     const PointsView& points)
    : base(square(parameters.split_distance)),
      range(square(parameters.noise_factor * sensor.range_stddev)),
      bearing(square(parameters.noise_factor * sensor.bearing_stddev)) {
  double farthest = 0.0;
  for (const double r : points.range) farthest = r > farthest ? r : farthest;
  largest = std::max({base, range, bearing * farthest * farthest});
}

FarthestPoint farthest_from(const NormalLine& line, const PointsView& points,
                            const Tolerance& tolerance) {
  FarthestPoint farthest;
  if (tolerance.raised()) {
    farthest_raised(points.range.data(), points.cosine.data(), points.sine.data(), points.x.data(),
                    points.y.data(), points.size(), line, tolerance, farthest);
  } else {
    farthest_fixed(points.x.data(), points.y.data(), points.size(), line,
                   1.0 / std::sqrt(tolerance.base), farthest);
  }
  return farthest;
}

FarthestPoint farthest_from_chord(const PointsView& points, const Tolerance& tolerance) {
  const double dx = points.x.back() - points.x.front();
  const double dy = points.y.back() - points.y.front();
  const double length = std::sqrt(dx * dx + dy * dy);
  if (length > 1e-9) {
    NormalLine chord{-dy / length, dx / length, 0.0};
    chord.offset = chord.normal_x * points.x.front() + chord.normal_y * points.y.front();
    const FarthestPoint farthest = farthest_from(chord, points, tolerance);
    if (farthest.excess * tolerance.largest <= length * length) return farthest;
  }
  // The contour of a whole room begins and ends at one place: the direction of so short a chord is
  // noise, and all points of a wall that it happens to be parallel to are equally far from it.
  FarthestPoint farthest;
  farthest_from_first(points.x.data(), points.y.data(), points.size(), 1.0 / tolerance.largest,
                      farthest);
  return farthest;
}

}  // namespace quoin
