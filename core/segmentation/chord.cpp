// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/segmentation/chord.hpp"

#include <algorithm>
#include <cmath>

#include "core/sensor/multiversion.hpp"

namespace quoin {
namespace {

/// Index of the point whose |normal_x x + normal_y y - offset| is largest. The maximum of each
/// block is found by vector instructions, its place only inside the best block.
QUOIN_MULTIVERSION
std::size_t index_of_farthest(const double* __restrict x, const double* __restrict y,
                              std::size_t count, double normal_x, double normal_y, double offset) {
  constexpr std::size_t block = 32;
  double largest = -1.0;
  std::size_t best_block = 0;
  std::size_t begin = 0;
  for (; begin + block <= count; begin += block) {
    double largest_here = 0.0;
    for (std::size_t i = begin; i < begin + block; ++i) {
      const double distance = std::abs(normal_x * x[i] + normal_y * y[i] - offset);
      largest_here = distance > largest_here ? distance : largest_here;
    }
    if (largest_here > largest) {
      largest = largest_here;
      best_block = begin;
    }
  }
  std::size_t index = 0;
  double largest_of_all = -1.0;
  const auto search = [&](std::size_t from, std::size_t to) {
    for (std::size_t i = from; i < to; ++i) {
      const double distance = std::abs(normal_x * x[i] + normal_y * y[i] - offset);
      if (distance > largest_of_all) {
        largest_of_all = distance;
        index = i;
      }
    }
  };
  if (begin > 0) search(best_block, best_block + block);
  search(begin, count);
  return index;
}

}  // namespace

FarthestPoint farthest_from_line(std::span<const double> x, std::span<const double> y,
                                 double normal_x, double normal_y, double offset) {
  const std::size_t index =
      index_of_farthest(x.data(), y.data(), x.size(), normal_x, normal_y, offset);
  return {index, std::abs(normal_x * x[index] + normal_y * y[index] - offset)};
}

FarthestPoint farthest_from_chord(std::span<const double> x, std::span<const double> y) {
  const double dx = x.back() - x.front();
  const double dy = y.back() - y.front();
  const double length = std::sqrt(dx * dx + dy * dy);
  if (length > 1e-9) {
    const double normal_x = -dy / length;
    const double normal_y = dx / length;
    return farthest_from_line(x, y, normal_x, normal_y,
                              normal_x * x.front() + normal_y * y.front());
  }
  // The contour of a whole room begins and ends at one place: the direction of so short a chord is
  // noise, and all points of a wall that it happens to be parallel to are equally far from it.
  FarthestPoint farthest;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double ex = x[i] - x.front();
    const double ey = y[i] - y.front();
    const double squared = ex * ex + ey * ey;
    if (squared > farthest.distance) farthest = {i, squared};
  }
  farthest.distance = std::sqrt(farthest.distance);
  return farthest;
}

}  // namespace quoin
