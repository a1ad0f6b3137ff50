// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/statistics/quantile_histogram.hpp"

#include <algorithm>
#include <cmath>

namespace quoin {
namespace {

const double log_ratio = std::log(1.02);  // neighbouring bucket borders

}  // namespace

void QuantileHistogram::add(double value) {
  int bucket = 0;
  if (value > minimum) {  // false for NaN, too
    const double position = std::log(value / minimum) / log_ratio;
    bucket = static_cast<int>(std::min(position, static_cast<double>(bucket_count - 1)));
  }
  ++buckets_[static_cast<std::size_t>(bucket)];
  ++count_;
}

void QuantileHistogram::clear() {
  buckets_.fill(0);
  count_ = 0;
}

double QuantileHistogram::quantile(double q) const {
  if (count_ == 0) return 0.0;
  const double fraction = std::clamp(q, 0.0, 1.0);
  // The rank-th smallest value, counted from 1.
  const auto rank = std::max<std::uint64_t>(
      1, static_cast<std::uint64_t>(std::ceil(fraction * static_cast<double>(count_))));
  std::uint64_t seen = 0;
  std::size_t bucket = 0;
  for (; bucket + 1 < buckets_.size(); ++bucket) {
    seen += buckets_[bucket];
    if (seen >= rank) break;
  }
  // Geometric middle of the bucket: at most 1 % from every value inside.
  return minimum * std::exp((static_cast<double>(bucket) + 0.5) * log_ratio);
}

}  // namespace quoin
