// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/statistics/interval.hpp"

#include <gtest/gtest.h>

namespace quoin {
namespace {

TEST(Proportion, IsWilsonsInterval) {
  // Worked by hand: p = 0.5, n = 4, z = 1.96 gives 0.5 +- 0.3500.
  const Interval half = proportion(2, 4);
  EXPECT_DOUBLE_EQ(half.value, 0.5);
  EXPECT_NEAR(half.low, 0.1500, 1e-4);
  EXPECT_NEAR(half.high, 0.8500, 1e-4);
  const Interval none = proportion(0, 10);
  EXPECT_DOUBLE_EQ(none.low, 0.0);
  EXPECT_NEAR(none.high, 0.2775, 1e-4);
  EXPECT_DOUBLE_EQ(proportion(0, 0).high, 0.0);
}

TEST(Proportion, WidensWhenTrialsAreCorrelated) {
  const Interval independent = proportion(950, 1000);
  const Interval correlated = proportion(950, 1000, 250.0);
  EXPECT_DOUBLE_EQ(independent.value, correlated.value);
  EXPECT_NEAR((correlated.high - correlated.low) / (independent.high - independent.low), 2.0, 0.1);
}

TEST(ClusteredProportion, KnowsThatTrialsOfOneClusterDependOnEachOther) {
  ClusteredProportion independent;
  ClusteredProportion together;
  for (int k = 0; k < 400; ++k) {
    independent.add(k % 4 == 0 ? 0 : 1, 1);
    if (k < 100) together.add(k % 4 == 0 ? 0 : 4, 4);
  }
  EXPECT_EQ(independent.trials(), together.trials());
  EXPECT_DOUBLE_EQ(independent.interval().value, 0.75);
  EXPECT_DOUBLE_EQ(together.interval().value, 0.75);
  const auto width = [](const Interval& interval) { return interval.high - interval.low; };
  EXPECT_NEAR(width(independent.interval()), width(proportion(300, 400)), 1e-12);
  // Four alike are worth one.
  EXPECT_NEAR(width(together.interval()), width(proportion(75, 100)), 1e-12);
  EXPECT_DOUBLE_EQ(ClusteredProportion{}.interval().high, 0.0);
}

TEST(Mean, HasTheStandardErrorOfTheMean) {
  // 1, 2, 3, 4: variance 5/3, standard error 0.6455.
  const Interval interval = mean(10.0, 30.0, 4);
  EXPECT_DOUBLE_EQ(interval.value, 2.5);
  EXPECT_NEAR(interval.high - interval.value, 1.96 * 0.6455, 1e-3);
  EXPECT_DOUBLE_EQ(mean(3.0, 9.0, 1).low, 3.0);
  EXPECT_DOUBLE_EQ(mean(0.0, 0.0, 0).high, 0.0);
}

}  // namespace
}  // namespace quoin
