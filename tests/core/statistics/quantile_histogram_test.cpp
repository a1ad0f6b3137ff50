// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include <limits>

#include <gtest/gtest.h>

#include "core/statistics/order_statistics.hpp"

namespace quoin {
namespace {

TEST(QuantileHistogram, IsExactToOnePercent) {
  QuantileHistogram histogram;
  EXPECT_EQ(histogram.quantile(0.5), 0.0);
  for (int i = 1; i <= 1000; ++i) histogram.add(i * 1e-5);
  EXPECT_EQ(histogram.count(), 1000U);
  for (const double q : {0.001, 0.5, 0.95, 0.99, 1.0}) {
    EXPECT_NEAR(histogram.quantile(q), q * 1e-2, q * 1.001e-4) << q;
  }
  histogram.clear();
  EXPECT_EQ(histogram.count(), 0U);
}

TEST(QuantileHistogram, TakesEverythingAtItsEnds) {
  QuantileHistogram histogram;
  histogram.add(-1.0);
  histogram.add(0.0);
  histogram.add(std::numeric_limits<double>::quiet_NaN());
  EXPECT_LT(histogram.quantile(1.0), 1.1e-9);
  histogram.add(std::numeric_limits<double>::infinity());
  histogram.add(1e300);
  EXPECT_GT(histogram.quantile(1.0), 1e9);
  EXPECT_EQ(histogram.count(), 5U);
}

}  // namespace
}  // namespace quoin
