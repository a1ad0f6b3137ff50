// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "deploy/orchestration/backoff.hpp"

#include <gmock/gmock.h>

namespace quoin::deploy {
namespace {

using namespace std::chrono_literals;

TEST(Backoff, DoublesUpToTenSeconds) {
  Backoff backoff;
  for (const auto pause : {200ms, 400ms, 800ms, 1600ms, 3200ms, 6400ms, 10000ms, 10000ms}) {
    EXPECT_EQ(backoff.next(1s), pause);
  }
}

TEST(Backoff, StartsAgainAfterALongLife) {
  Backoff backoff;
  EXPECT_EQ(backoff.next(1s), 200ms);
  EXPECT_EQ(backoff.next(1s), 400ms);
  EXPECT_EQ(backoff.next(10s), 200ms);
  EXPECT_EQ(backoff.next(9999ms), 400ms);
}

}  // namespace
}  // namespace quoin::deploy
