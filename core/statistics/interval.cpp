// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/statistics/interval.hpp"

#include <algorithm>
#include <cmath>

#include "core/statistics/chi_square.hpp"

namespace quoin {

Interval proportion(std::size_t hits, std::size_t trials, double effective) {
  if (trials == 0 || !(effective > 0.0)) return {};
  const double p = static_cast<double>(hits) / static_cast<double>(trials);
  const double z2 = normal_97_5 * normal_97_5;
  const double centre = (p + z2 / (2.0 * effective)) / (1.0 + z2 / effective);
  const double half = normal_97_5 *
                      std::sqrt(p * (1.0 - p) / effective + z2 / (4.0 * effective * effective)) /
                      (1.0 + z2 / effective);
  return {p, std::max(0.0, centre - half), std::min(1.0, centre + half)};
}

Interval mean(double sum, double sum_of_squares, std::size_t count) {
  if (count == 0) return {};
  const auto n = static_cast<double>(count);
  const double value = sum / n;
  const double variance =
      count > 1 ? std::max(0.0, (sum_of_squares - n * value * value) / (n - 1.0)) : 0.0;
  const double half = normal_97_5 * std::sqrt(variance / n);
  return {value, value - half, value + half};
}

void ClusteredProportion::add(std::size_t hits, std::size_t trials) {
  const auto h = static_cast<double>(hits);
  const auto t = static_cast<double>(trials);
  hits_ += hits;
  trials_ += trials;
  hits_squared_ += h * h;
  product_ += h * t;
  trials_squared_ += t * t;
}

Interval ClusteredProportion::interval() const {
  if (trials_ == 0) return {};
  const auto count = static_cast<double>(trials_);
  const double p = static_cast<double>(hits_) / count;
  // Linearised variance of a ratio of sums over clusters.
  const double variance =
      (hits_squared_ - 2.0 * p * product_ + p * p * trials_squared_) / (count * count);
  const double effective = variance > 0.0 ? std::min(count, p * (1.0 - p) / variance) : count;
  return proportion(hits_, trials_, effective > 0.0 ? effective : count);
}

}  // namespace quoin
