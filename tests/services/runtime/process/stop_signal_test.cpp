// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/runtime/process/stop_signal.hpp"

#include <atomic>
#include <csignal>
#include <unistd.h>

#include <gtest/gtest.h>

namespace quoin::runtime {
namespace {

using namespace std::chrono_literals;
using std::chrono::steady_clock;

TEST(StopSignal, WaitEndsAtItsTime) {
  StopSignal stop;
  EXPECT_TRUE(stop.wait_until(steady_clock::now() + 1ms));
  EXPECT_FALSE(stop.requested());
}

TEST(StopSignal, SigtermEndsAWait) {
  StopSignal stop;
  kill(getpid(), SIGTERM);
  EXPECT_FALSE(stop.wait_until(steady_clock::now() + 60s));
  EXPECT_TRUE(stop.requested());
}

TEST(StopSignal, CallsBackOnce) {
  StopSignal stop;
  std::atomic<int> calls = 0;
  stop.on_request([&] { ++calls; });
  stop.request();
  stop.request();
  EXPECT_EQ(calls, 1);
}

TEST(StopSignal, CallsBackAtOnceWhenLate) {
  StopSignal stop;
  stop.request();
  int calls = 0;
  stop.on_request([&] { ++calls; });
  EXPECT_EQ(calls, 1);
}

TEST(StopSignal, ACallbackCanBeTakenBack) {
  StopSignal stop;
  int calls = 0;
  stop.on_request([&] { ++calls; });
  stop.on_request(nullptr);
  stop.request();
  EXPECT_EQ(calls, 0);
}

}  // namespace
}  // namespace quoin::runtime
