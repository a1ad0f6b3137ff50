// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

namespace quoin {

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
