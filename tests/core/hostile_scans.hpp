// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <random>
#include <string_view>
#include <vector>

#include "core/sensor/scan.hpp"

namespace quoin {

/// Shapes that no room has and that are hard for one method or another. The periods and heights of
/// sawtooth are those of the slowest scan of some hundreds that were tried.
inline constexpr std::array<std::string_view, 6> hostile_shapes{
    "sawtooth", "fine_sawtooth", "shrinking_sawtooth", "spiral", "random", "constant"};

/// A revolution of `count` rays.
[[nodiscard]] inline Points hostile_scan(std::string_view shape, std::size_t count) {
  std::vector<float> bearings(count);
  std::vector<float> ranges(count);
  std::mt19937_64 random(20260422);
  std::uniform_real_distribution<double> anywhere(1.0, 10.0);
  const auto tooth = [](std::size_t i, std::size_t period) {
    const std::size_t k = i % period;
    return 2.0 * static_cast<double>(k < period / 2 ? k : period - k) / static_cast<double>(period);
  };
  for (std::size_t i = 0; i < count; ++i) {
    const double part = static_cast<double>(i) / static_cast<double>(count);
    double range = 5.0;
    if (shape == "sawtooth") range = 3.0 + 0.15 * tooth(i, 40);
    if (shape == "fine_sawtooth") range = 3.0 + 0.1 * tooth(i, 4);
    if (shape == "shrinking_sawtooth") range = 3.0 + 0.1 * (1.0 - 0.5 * part) * tooth(i, 10);
    if (shape == "spiral") range = 1.0 + 10.0 * part;
    if (shape == "random") range = anywhere(random);
    bearings[i] = static_cast<float>(std::numbers::pi * (2.0 * part - 1.0));
    ranges[i] = static_cast<float>(range);
  }
  Points points;
  convert({bearings, ranges, 0.1, 100.0}, points);
  return points;
}

}  // namespace quoin
