// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/statistics/order_statistics.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "core/sensor/multiversion.hpp"

namespace quoin {
namespace {

constexpr float precision = 1e-3F;

/// By bisection: it counts values, without a branch for any of them.
QUOIN_MULTIVERSION
void bisect(const float* values, int count, float& out) {
  float low = 0.0F;
  float high = 0.0F;
  for (int i = 0; i < count; ++i) high = values[i] > high ? values[i] : high;
  constexpr float largest = std::numeric_limits<float>::max();
  high = high < largest ? high : largest;
  while (high - low > precision * high) {
    const float middle = 0.5F * (low + high);
    int below = 0;
    for (int i = 0; i < count; ++i) below += values[i] <= middle ? 1 : 0;
    (2 * below > count ? high : low) = middle;
  }
  out = high;
}

double quantile_of_sorted(const std::vector<double>& sorted, double q) {
  if (sorted.empty()) return 0.0;
  const double position = std::clamp(q, 0.0, 1.0) * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(position);
  const std::size_t above = std::min(below + 1, sorted.size() - 1);
  const double part = position - static_cast<double>(below);
  return sorted[below] + part * (sorted[above] - sorted[below]);
}

const double log_ratio = std::log(1.02);  // neighbouring borders of buckets of a QuantileHistogram

}  // namespace

double quantile(std::vector<double> values, double q) {
  std::sort(values.begin(), values.end());
  return quantile_of_sorted(values, q);
}

float approximate_median(std::span<const float> values) {
  float median = 0.0F;
  bisect(values.data(), static_cast<int>(values.size()), median);
  return median;
}

std::vector<std::size_t> indices_of_least(std::vector<std::pair<double, std::size_t>> values,
                                          std::size_t most) {
  std::sort(values.begin(), values.end());
  if (values.size() > most) values.resize(most);
  std::vector<std::size_t> indices;
  for (const auto& [value, index] : values) indices.push_back(index);
  std::sort(indices.begin(), indices.end());
  return indices;
}

BoxSummary box_summary(const std::vector<double>& values) {
  BoxSummary box;
  if (values.empty()) return box;
  std::vector<double> sorted = values;
  std::sort(sorted.begin(), sorted.end());
  box.first_quartile = quantile_of_sorted(sorted, 0.25);
  box.median = quantile_of_sorted(sorted, 0.5);
  box.third_quartile = quantile_of_sorted(sorted, 0.75);
  const double reach = 1.5 * (box.third_quartile - box.first_quartile);
  box.low = box.first_quartile;
  box.high = box.third_quartile;
  for (const double value : sorted) {
    if (value < box.first_quartile - reach || value > box.third_quartile + reach) {
      box.outliers.push_back(value);
    } else {
      box.low = std::min(box.low, value);
      box.high = std::max(box.high, value);
    }
  }
  return box;
}

double standard_deviation(const std::vector<double>& values) {
  if (values.size() < 2) return 0.0;
  const auto count = static_cast<double>(values.size());
  double sum = 0.0;
  for (const double value : values) sum += value;
  double squares = 0.0;
  for (const double value : values) squares += (value - sum / count) * (value - sum / count);
  return std::sqrt(squares / (count - 1.0));
}

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
