// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/parameters/suggestion.hpp"

#include <gtest/gtest.h>

namespace quoin {
namespace {

TEST(NearestName, CountsSwapsOnce) {
  EXPECT_EQ(nearest_name("wclts", {"utls", "wtls", "wctls"}), "wctls");
  EXPECT_EQ(nearest_name("min_point", {"min_length", "min_points"}), "min_points");
  EXPECT_EQ(nearest_name("", {"a"}), "");
  EXPECT_EQ(nearest_name("abc", {}), "");
}

TEST(Suggestion, ListsWhenNothingIsNear) {
  EXPECT_EQ(suggestion("iepf2", {"iepf"}), "; did you mean 'iepf'?");
  EXPECT_EQ(suggestion("zzzzzz", {"utls", "wtls"}), "; known are utls, wtls");
  EXPECT_EQ(suggestion("zzzzzz", {}), "");
}

}  // namespace
}  // namespace quoin
