// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/calibration/quantization.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace quoin {
namespace {

constexpr std::size_t fewest_values = 50;  // that differ
constexpr double smallest_step = 1e-4;     // [m]
constexpr double apart = 2e-5;             // [m] values nearer to each other are the same
constexpr double range_rounding = 2e-7;    // of a range in single precision
constexpr double tolerance = 0.05;         // of a step; by chance a tenth of all are within it
constexpr double enough_values = 0.99;     // of the values

double off_multiple(double value, double step) {
  return std::abs(value - step * std::round(value / step));
}

/// A low quantile of the gaps between neighbours: where ranges are dense, they are one step apart.
double small_gap(const std::vector<double>& values) {
  std::vector<double> gaps;
  for (std::size_t i = 1; i < values.size(); ++i) gaps.push_back(values[i] - values[i - 1]);
  const auto low = gaps.begin() + static_cast<std::ptrdiff_t>(gaps.size() / 20);
  std::nth_element(gaps.begin(), low, gaps.end());
  return *low;
}

}  // namespace

double quantization_step(std::span<const float> ranges) {
  std::vector<double> values(ranges.begin(), ranges.end());
  std::sort(values.begin(), values.end());
  values.erase(
      std::unique(values.begin(), values.end(), [](double a, double b) { return b - a < apart; }),
      values.end());
  if (values.size() < fewest_values) return 0.0;

  double step = small_gap(values);
  if (step < 0.99 * smallest_step) return 0.0;
  // The farther two values are apart, the more exactly they show the step; how many steps there are
  // between them has to be certain before.
  for (std::size_t apart_by = 1; apart_by < values.size(); apart_by *= 2) {
    double products = 0.0;
    double squares = 0.0;
    for (std::size_t i = apart_by; i < values.size(); ++i) {
      const double difference = values[i] - values[i - apart_by];
      if (off_multiple(difference, step) > 0.25 * step) continue;
      const double steps = std::round(difference / step);
      products += difference * steps;
      squares += steps * steps;
    }
    if (squares > 0.0) step = products / squares;
  }
  if (step < 0.99 * smallest_step) return 0.0;
  std::size_t fitting = 0;
  for (const double value : values) {
    if (off_multiple(value, step) < tolerance * step + range_rounding * value) ++fitting;
  }
  return static_cast<double>(fitting) >= enough_values * static_cast<double>(values.size()) ? step
                                                                                            : 0.0;
}

}  // namespace quoin
