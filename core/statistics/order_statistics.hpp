// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <utility>
#include <vector>

namespace quoin {

/// Value below which the fraction `q` (0..1) of all lies, linear between neighbours; 0 when there
/// is none.
[[nodiscard]] double quantile(std::vector<double> values, double q);

[[nodiscard]] inline double median(std::vector<double> values) {
  return quantile(std::move(values), 0.5);
}

/// Median of values that are not negative, to one part in a thousand: for the data path, where
/// sorting would cost more than all else that is done with them. 0 when there is none.
[[nodiscard]] float approximate_median(std::span<const float> values);

/// What a box plot shows of values: whiskers reach to the last value within 1.5 times the distance
/// of the quartiles from the box.
struct BoxSummary {
  double low = 0.0;
  double first_quartile = 0.0;
  double median = 0.0;
  double third_quartile = 0.0;
  double high = 0.0;
  std::vector<double> outliers;
};

[[nodiscard]] BoxSummary box_summary(const std::vector<double>& values);

/// Standard deviation of the values around their mean; 0 for fewer than two.
[[nodiscard]] double standard_deviation(const std::vector<double>& values);

}  // namespace quoin
