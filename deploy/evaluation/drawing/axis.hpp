// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace quoin::deploy {

/// An axis of a plot as its user describes it.
struct PlotAxis {
  std::string title;  ///< with the unit in brackets
  bool logarithmic = false;
  std::optional<double> low = std::nullopt;   ///< else from the data
  std::optional<double> high = std::nullopt;  ///< else from the data
};

struct Tick {
  double value = 0.0;
  std::string label;  ///< "" for a grid line without one
};

/// An axis laid out: from values to pixels.
class Scale {
 public:
  /// Covers `values` that can be shown (finite; positive when logarithmic) between the pixels
  /// `from` and `to`, either of which may be the greater.
  Scale(const PlotAxis& axis, const std::vector<double>& values, double from, double to);

  /// Values outside the axis land on its ends.
  [[nodiscard]] double pixel(double value) const;
  [[nodiscard]] bool shows(double value) const;
  [[nodiscard]] std::vector<Tick> ticks() const;

 private:
  [[nodiscard]] double position(double value) const;  // 0 at low, 1 at high

  bool logarithmic_ = false;
  double low_ = 0.0;
  double high_ = 1.0;
  double from_ = 0.0;
  double to_ = 1.0;
};

/// A number for the eye: few digits, a power of ten where it is very large or small.
[[nodiscard]] std::string tick_label(double value);

}  // namespace quoin::deploy
