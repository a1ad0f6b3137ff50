// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "deploy/evaluation/drawing/axis.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>

#include "deploy/evaluation/drawing/svg.hpp"

namespace quoin::deploy {

namespace {

constexpr double tick_distance = 80.0;  // pixels, about

/// Smallest of 1, 2 and 5 times a power of ten that is not below `value`.
double round_up(double value) {
  const double power = std::pow(10.0, std::floor(std::log10(value)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * power >= value * (1.0 - 1e-9)) return factor * power;
  }
  return 10.0 * power;
}

}  // namespace

std::string tick_label(double value) {
  const double size = std::abs(value);
  if (size == 0.0) return "0";
  if (size >= 1e6 || size < 1e-3) {
    std::array<char, 32> buffer{};
    std::snprintf(buffer.data(), buffer.size(), "%.3g", value);
    return buffer.data();
  }
  const int digits = std::max(0, 3 - static_cast<int>(std::floor(std::log10(size))));
  return number(value, digits);
}

Scale::Scale(const PlotAxis& axis, const std::vector<double>& values, double from, double to)
    : logarithmic_(axis.logarithmic), from_(from), to_(to) {
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (const double value : values) {
    if (!std::isfinite(value) || (logarithmic_ && value <= 0.0)) continue;
    low = std::min(low, value);
    high = std::max(high, value);
  }
  if (low > high) {
    low = logarithmic_ ? 1.0 : 0.0;
    high = logarithmic_ ? 10.0 : 1.0;
  }
  // A margin, so that no mark sits on the frame.
  if (logarithmic_) {
    const double margin = std::max(1.15, std::pow(high / low, 0.04));
    low /= margin;
    high *= margin;
  } else {
    const double extent = high - low;
    const double margin = extent > 0.0 ? 0.04 * extent : std::max(0.5 * std::abs(high), 1e-9);
    const bool from_zero = low >= 0.0 && low <= 0.3 * high;
    low = from_zero ? 0.0 : low - margin;
    high += margin;
  }
  low_ = axis.low.value_or(low);
  high_ = axis.high.value_or(high);
  if (!(high_ > low_)) high_ = logarithmic_ ? 10.0 * low_ : low_ + 1.0;
}

double Scale::position(double value) const {
  return logarithmic_ ? std::log(value / low_) / std::log(high_ / low_)
                      : (value - low_) / (high_ - low_);
}

double Scale::pixel(double value) const {
  if (logarithmic_ && value <= 0.0) return from_;
  return from_ + std::clamp(position(value), 0.0, 1.0) * (to_ - from_);
}

bool Scale::shows(double value) const {
  return std::isfinite(value) && value >= low_ && value <= high_;
}

std::vector<Tick> Scale::ticks() const {
  std::vector<Tick> ticks;
  const double length = std::abs(to_ - from_);
  if (logarithmic_) {
    const double decades = std::log10(high_ / low_);
    const double pixels = length / decades;
    const auto every = static_cast<int>(std::max(1.0, std::ceil(0.6 * tick_distance / pixels)));
    for (int power = static_cast<int>(std::floor(std::log10(low_))); std::pow(10.0, power) <= high_;
         ++power) {
      for (const double factor : {1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0}) {
        const double value = factor * std::pow(10.0, power);
        if (value < low_ || value > high_) continue;
        const bool decade = factor == 1.0 && power % every == 0;
        const bool between = pixels > 2.5 * tick_distance && (factor == 2.0 || factor == 5.0);
        ticks.push_back({value, decade || between ? tick_label(value) : ""});
      }
    }
    return ticks;
  }
  const double step = round_up((high_ - low_) * tick_distance / length);
  const auto first = static_cast<long>(std::ceil(low_ / step - 1e-9));
  for (long i = first; static_cast<double>(i) * step <= high_ + 1e-9 * step; ++i) {
    const double value = static_cast<double>(i) * step;
    ticks.push_back({value, tick_label(value)});
  }
  return ticks;
}

}  // namespace quoin::deploy
