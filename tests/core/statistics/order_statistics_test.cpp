// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/statistics/order_statistics.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace quoin {
namespace {

TEST(OrderStatistics, QuantilesAreLinearBetweenNeighbours) {
  EXPECT_DOUBLE_EQ(quantile({4.0, 1.0, 3.0, 2.0}, 0.25), 1.75);
  EXPECT_DOUBLE_EQ(quantile({4.0, 1.0, 3.0, 2.0}, 0.0), 1.0);
  EXPECT_DOUBLE_EQ(quantile({4.0, 1.0, 3.0, 2.0}, 1.0), 4.0);
  EXPECT_DOUBLE_EQ(median({4.0, 1.0, 3.0, 2.0}), 2.5);
  EXPECT_DOUBLE_EQ(median({3.0, 1.0, 2.0}), 2.0);
  EXPECT_EQ(median({}), 0.0);
}

TEST(OrderStatistics, IndicesOfTheLeastAscend) {
  EXPECT_EQ(indices_of_least({{0.5, 7}, {-1.0, 9}, {0.2, 3}}, 2), (std::vector<std::size_t>{3, 9}));
  EXPECT_EQ(indices_of_least({{1.0, 4}, {1.0, 2}}, 1), (std::vector<std::size_t>{2}));
  EXPECT_EQ(indices_of_least({{1.0, 4}, {0.0, 2}}, 5), (std::vector<std::size_t>{2, 4}));
  EXPECT_TRUE(indices_of_least({}, 3).empty());
}

TEST(OrderStatistics, WhiskersEndWithinOneAndAHalfBoxes) {
  const BoxSummary box = box_summary({1.0, 2.0, 3.0, 4.0, 5.0, 20.0, 2.5, 3.5, 4.5});
  EXPECT_DOUBLE_EQ(box.median, 3.5);
  EXPECT_DOUBLE_EQ(box.first_quartile, 2.5);
  EXPECT_DOUBLE_EQ(box.third_quartile, 4.5);
  EXPECT_DOUBLE_EQ(box.low, 1.0);
  EXPECT_DOUBLE_EQ(box.high, 5.0);
  EXPECT_EQ(box.outliers, std::vector{20.0});
}

TEST(OrderStatistics, StandardDeviationIsThatOfASample) {
  EXPECT_DOUBLE_EQ(standard_deviation({1.0, 3.0}), std::sqrt(2.0));
  EXPECT_EQ(standard_deviation({1.0}), 0.0);
}

}  // namespace
}  // namespace quoin
