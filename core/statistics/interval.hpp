// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

namespace quoin {

/// A figure found by counting or averaging, with its 95 % confidence interval.
struct Interval {
  double value = 0.0;
  double low = 0.0;
  double high = 0.0;
};

/// Wilson's interval of a proportion from `effective` independent trials (fewer than `trials` when
/// they are correlated). All zero without trials.
[[nodiscard]] Interval proportion(std::size_t hits, std::size_t trials, double effective);
[[nodiscard]] inline Interval proportion(std::size_t hits, std::size_t trials) {
  return proportion(hits, trials, static_cast<double>(trials));
}

/// Mean of independent values from their sums, interval by the normal distribution.
[[nodiscard]] Interval mean(double sum, double sum_of_squares, std::size_t count);

/// Counts of clusters, such as scans, of which the proportion over all is wanted: trials of one
/// cluster may depend on each other, those of different clusters do not.
class ClusteredProportion {
 public:
  void add(std::size_t hits, std::size_t trials);
  [[nodiscard]] std::size_t hits() const { return hits_; }
  [[nodiscard]] std::size_t trials() const { return trials_; }
  [[nodiscard]] Interval interval() const;

 private:
  std::size_t hits_ = 0, trials_ = 0;
  double hits_squared_ = 0.0, product_ = 0.0, trials_squared_ = 0.0;
};

/// Values of which the mean and its uncertainty are wanted.
struct MeanSums {
  double sum = 0.0;
  double squares = 0.0;
  std::size_t count = 0;

  void add(double value) {
    sum += value;
    squares += value * value;
    ++count;
  }
  [[nodiscard]] Interval mean() const { return quoin::mean(sum, squares, count); }
};

}  // namespace quoin
