// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/segmentation/chord.hpp"

#include <cmath>
#include <limits>

#include "core/sensor/multiversion.hpp"

namespace quoin {
namespace {

/// Largest measure(i) for i < count, and its place when it is above `limit`. The maximum of each
/// block is found by vector instructions; only the best block is searched, and most segments are
/// straight and not searched at all.
template <class Measure>
[[gnu::always_inline]] inline FarthestPoint largest_of(std::size_t count, double limit,
                                                       const Measure& measure) {
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
  if (largest <= limit) return {0, largest};

  // Vector and scalar instructions may round differently; the last point of the block is the rest.
  const double almost = largest * (1.0 - 1e-12);
  const std::size_t end = best_begin + block < count ? best_begin + block : count;
  std::size_t index = best_begin;
  while (index + 1 < end && measure(index) < almost) ++index;
  return {index, largest};
}

QUOIN_MULTIVERSION
void farthest_from_line(const double* __restrict x, const double* __restrict y, std::size_t count,
                        double normal_x, double normal_y, double offset, double limit,
                        FarthestPoint& out) {
  out = largest_of(count, limit, [=](std::size_t i) {
    return std::abs(normal_x * x[i] + normal_y * y[i] - offset);
  });
}

QUOIN_MULTIVERSION
void farthest_from_first(const double* __restrict x, const double* __restrict y, std::size_t count,
                         double limit_squared, FarthestPoint& out) {
  out = largest_of(count, limit_squared, [=](std::size_t i) {
    return (x[i] - x[0]) * (x[i] - x[0]) + (y[i] - y[0]) * (y[i] - y[0]);
  });
  out.distance = std::sqrt(out.distance);
}

}  // namespace

double largest_distance(std::span<const double> x, std::span<const double> y, double normal_x,
                        double normal_y, double offset) {
  FarthestPoint farthest;
  farthest_from_line(x.data(), y.data(), x.size(), normal_x, normal_y, offset,
                     std::numeric_limits<double>::max(), farthest);
  return farthest.distance;
}

FarthestPoint farthest_from_chord(std::span<const double> x, std::span<const double> y,
                                  double limit) {
  const double dx = x.back() - x.front();
  const double dy = y.back() - y.front();
  const double length = std::sqrt(dx * dx + dy * dy);
  FarthestPoint farthest;
  if (length > 1e-9) {
    const double normal_x = -dy / length;
    const double normal_y = dx / length;
    farthest_from_line(x.data(), y.data(), x.size(), normal_x, normal_y,
                       normal_x * x.front() + normal_y * y.front(), limit, farthest);
    if (farthest.distance <= length) return farthest;
  }
  // The contour of a whole room begins and ends at one place: the direction of so short a chord is
  // noise, and all points of a wall that it happens to be parallel to are equally far from it.
  farthest_from_first(x.data(), y.data(), x.size(), limit * limit, farthest);
  return farthest;
}

}  // namespace quoin
