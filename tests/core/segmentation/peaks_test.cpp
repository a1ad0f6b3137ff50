// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/segmentation/peaks.hpp"

#include <vector>

#include <gmock/gmock.h>

namespace quoin {
namespace {

std::vector<std::size_t> peaks(const std::vector<double>& values, const Segment& range,
                               std::size_t reach, double limit) {
  std::vector<std::size_t> found;
  for (std::size_t i = range.begin; i < range.end; ++i) {
    if (is_peak(values, range, i, reach, limit)) found.push_back(i);
  }
  return found;
}

using testing::ElementsAre;

TEST(IsPeak, IsTheLargestNearby) {
  const std::vector<double> values{0, 3, 1, 2, 0, 0, 5, 5, 4, 6};
  EXPECT_THAT(peaks(values, {0, 10}, 1, 0.0), ElementsAre(1, 3, 6, 9));
  EXPECT_THAT(peaks(values, {0, 10}, 2, 0.0), ElementsAre(1, 6, 9));
  EXPECT_THAT(peaks(values, {0, 10}, 20, 0.0), ElementsAre(9));
}

TEST(IsPeak, IsAboveTheLimit) {
  EXPECT_THAT(peaks({0, 3, 1, 2, 0}, {0, 5}, 1, 2.0), ElementsAre(1));
  EXPECT_THAT(peaks({0, 0, 0}, {0, 3}, 1, 0.0), ElementsAre());
}

TEST(IsPeak, LooksInsideTheRangeOnly) {
  EXPECT_THAT(peaks({9, 1, 2, 1, 9}, {1, 4}, 3, 0.0), ElementsAre(2));
  EXPECT_THAT(peaks({4, 4, 4, 4}, {0, 4}, 3, 0.0), ElementsAre(0));  // the first of equals
}

}  // namespace
}  // namespace quoin
