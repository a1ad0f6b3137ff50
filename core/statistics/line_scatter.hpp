// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <deque>
#include <optional>
#include <string>
#include <string_view>

#include "core/statistics/interval.hpp"

namespace quoin {

/// How much lines scatter, by what the sensor model says.
struct LineScatter {
  std::size_t lines = 0;
  /// Median over the lines of chi-square over its degrees of freedom, divided by the median that
  /// chance makes of it: 1 when the model is true. Few odd walls do not move it.
  Interval reduced_chi_square;
  std::size_t split_lines = 0;  ///< of which the odd and the even points were fitted apart
  Interval split_inside95;      ///< share of them in the 95 % bound of their difference
};

/// The scatter of the lines of the last minute.
class RunningScatter {
 public:
  static constexpr double window = 60.0;           ///< [s]
  static constexpr std::size_t most_lines = 8192;  ///< the newest, where more come in a minute

  /// A line of so many points, at least 3, at a time [s] that does not decrease.
  void add(double time, double chi_square, std::size_t points);
  /// The squared distance of the lines of its odd and even points (`odd_even_squared`).
  void add_split(double time, double squared);
  void clear();
  /// Of the lines since `time` - window.
  [[nodiscard]] LineScatter scatter(double time);

 private:
  struct Value {
    double time;
    double value;
  };
  static void trim(std::deque<Value>& values, double time);
  std::deque<Value> reduced_;
  std::deque<Value> splits_;
};

/// Name and value of the entry of a heartbeat that carries it.
inline constexpr std::string_view line_scatter_diagnostic = "Reduced Chi-Square";
[[nodiscard]] std::string to_text(const LineScatter& scatter);
/// Nothing for a text that is none of `to_text`.
[[nodiscard]] std::optional<LineScatter> parse_line_scatter(std::string_view text);

/// "lines scatter 1.9 times as much as the sensor model (range_stddev) says: ...", when there are
/// enough lines and it is true of the whole interval; else "".
[[nodiscard]] std::string complaint(const LineScatter& scatter);
/// What to do about it.
inline constexpr std::string_view scatter_advice =
    "run quoin calibrate and declare what it measures at the source of the scans";

}  // namespace quoin
