// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
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

/// The indices of the `most` least values, which stand beside them, ascending; of equal values
/// those of the least indices.
[[nodiscard]] std::vector<std::size_t> indices_of_least(
    std::vector<std::pair<double, std::size_t>> values, std::size_t most);

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

/// Quantiles of a stream of positive numbers in constant memory, exact to 1 % of the value between
/// 1e-9 and 1e9; smaller and larger ones count at the ends.
class QuantileHistogram {
 public:
  void add(double value);
  void clear();
  [[nodiscard]] std::uint64_t count() const { return count_; }
  /// Value below which the fraction `q` (0..1) of all lies; 0 when there is none.
  [[nodiscard]] double quantile(double q) const;

 private:
  static constexpr double minimum = 1e-9;
  static constexpr int bucket_count = 2100;  // ln(1e18) / ln(1.02) = 2093: half a bucket is 1 %
  std::array<std::uint32_t, bucket_count> buckets_{};
  std::uint64_t count_ = 0;
};

}  // namespace quoin
