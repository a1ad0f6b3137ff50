// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
//
// Headers that somebody has made up, among those of a source that gives ten scans a second.
#include <gtest/gtest.h>

#include "services/runtime/accounting/accounting.hpp"
#include "services/topics/header.hpp"

namespace quoin::runtime {
namespace {

using std::chrono::milliseconds;
using Verdict = ScanAccounting::Verdict;

class ForeignHeaders : public testing::Test {
 protected:
  Verdict receive(std::uint64_t number, std::uint64_t incarnation = 1) {
    msg::Header header;
    topics::set_origin(header, "front", incarnation, number);
    msg::StageTrace& trace = header.trace().emplace_back();
    trace.service("front");
    trace.incarnation(incarnation);
    trace.index(number);
    accounting_.receive(header);
    return accounting_.verdict();
  }
  /// The next `count` scans of the source; how many were used.
  int scans(int count) {
    int used = 0;
    for (int i = 0; i < count; ++i) {
      used += receive(next_++) == Verdict::received ? 1 : 0;
      now_ += milliseconds(100);
    }
    return used;
  }

  ScanAccounting::Clock::time_point now_{};
  ScanAccounting accounting_{[this] { return now_; }};
  std::uint64_t next_ = 0;
};

TEST_F(ForeignHeaders, ANumberThatNoSensorCanHaveReachedIsRefused) {
  EXPECT_EQ(scans(10), 10);
  EXPECT_EQ(receive(1'000'000'000), Verdict::implausible);
  EXPECT_EQ(scans(10), 10);
  EXPECT_EQ(accounting_.received(), 20U);
  EXPECT_EQ(accounting_.lost(), 0U);
  EXPECT_EQ(accounting_.implausible(), 1U);
}

TEST_F(ForeignHeaders, AStreamThatWouldBeAllDuplicatesIsJoinedAgain) {
  EXPECT_EQ(scans(10), 10);
  EXPECT_EQ(receive(900), Verdict::received);
  EXPECT_EQ(accounting_.lost(), 890U);
  EXPECT_EQ(scans(10), 5);  // within half a second
  // What was taken for losses is none; what was not used meanwhile is.
  EXPECT_EQ(accounting_.lost(), 5U);
  EXPECT_EQ(accounting_.received(), 15U);
  EXPECT_EQ(accounting_.received() + accounting_.lost(), 20U);
  ASSERT_EQ(accounting_.sources().size(), 1U);
  EXPECT_EQ(accounting_.sources()[0].accounted, 20U);
}

TEST_F(ForeignHeaders, LateScansAreRepetitionsAsLongAsOthersCome) {
  EXPECT_EQ(scans(20), 20);
  for (std::uint64_t late = 0; late < 15; ++late) {
    EXPECT_EQ(receive(late), Verdict::duplicate);
    EXPECT_EQ(scans(1), 1);
  }
  EXPECT_EQ(accounting_.duplicates(), 15U);
  EXPECT_EQ(accounting_.lost(), 0U);
}

TEST_F(ForeignHeaders, ABurstOfRepetitionsIsNoStream) {
  EXPECT_EQ(scans(20), 20);
  for (std::uint64_t late = 0; late < 20; ++late) {
    EXPECT_EQ(receive(late), Verdict::duplicate);
    now_ += milliseconds(2);
  }
  EXPECT_EQ(scans(1), 1);
}

TEST_F(ForeignHeaders, ALongPauseExplainsALargeNumber) {
  EXPECT_EQ(scans(1), 1);
  now_ += std::chrono::hours(1);
  EXPECT_EQ(receive(3'600'000), Verdict::received);
  EXPECT_EQ(accounting_.lost(), 3'599'999U);
}

TEST_F(ForeignHeaders, AProcessThatStartsAgainHasNotGotFar) {
  EXPECT_EQ(scans(10), 10);
  EXPECT_EQ(receive(1U << 30U, 2), Verdict::implausible);
  EXPECT_EQ(scans(10), 10);
}

TEST_F(ForeignHeaders, OfInventedProcessesTheLastAreKept) {
  for (std::uint64_t i = 1; i <= 10'000; ++i) receive(0, i);
  EXPECT_LE(accounting_.sources().size(), 256U);
  EXPECT_EQ(accounting_.sources().back().incarnation, 10'000U);
  // The accounts of the processes that are remembered may have been dropped.
  for (std::uint64_t i = 10'000; i > 9'990; --i) receive(1, i);
  for (std::uint64_t i = 1; i < 1000; ++i) receive(2, i);
}

}  // namespace
}  // namespace quoin::runtime
