// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/runtime/accounting/source_ledger.hpp"

#include <random>

#include <gtest/gtest.h>

#include "services/topics/header.hpp"

namespace quoin::runtime {
namespace {

SourceAccount account(std::uint64_t incarnation, std::uint64_t accounted, bool begins = false) {
  return {incarnation, accounted, 0, begins, false};
}

/// Of processes that started at 10, 20, ... and have published this.
SourceLedger ledger_of(const std::vector<std::uint64_t>& published) {
  SourceLedger ledger;
  std::uint64_t incarnation = 0;
  for (const std::uint64_t scans : published) ledger.add(incarnation += 10, {0, scans, 0});
  return ledger;
}

TEST(SourceLedger, WhatIsBehindTheLastScanOfAProcessIsUnsettledOnceAnotherOneIsHeard) {
  SourceLedger ledger = ledger_of({100, 50});
  EXPECT_EQ(ledger.published(), 150U);
  EXPECT_EQ(ledger.unaccounted({account(10, 90, true)}, false), 0U) << "they may come";
  EXPECT_EQ(ledger.unaccounted({account(10, 90, true), account(20, 5)}, false), 10U);
  EXPECT_EQ(ledger.unaccounted({account(10, 90, true), account(20, 5)}, true), 55U);
  EXPECT_EQ(ledger.unaccounted({account(10, 90, true)}, true), 60U) << "the other was never heard";
}

TEST(SourceLedger, AProcessThatWasNeverHeardIsUnsettledWhenTheNextOneIs) {
  SourceLedger ledger;
  ledger.add(10, {0, 100, 0});
  ledger.add(20, {0, 50, 3});
  ledger.add(30, {0, 7, 0});
  EXPECT_EQ(ledger.unaccounted({account(10, 100, true), account(30, 2)}, false), 53U);
}

TEST(SourceLedger, AProcessThatWasHeldWhileTheOneBeforeWasStartedAgainIsSettledByItself) {
  const SourceLedger ledger = ledger_of({100, 50, 7});
  SourceAccount restarted = account(30, 7);
  restarted.handed_over = true;
  const std::vector<SourceAccount> accounts{account(10, 100, true), restarted, account(20, 50)};
  EXPECT_EQ(ledger.unaccounted(accounts, true), 0U);
  EXPECT_EQ(ledger.unaccounted({account(10, 90, true), restarted, account(20, 45)}, true), 15U);
}

TEST(SourceLedger, WhatTheSourceLostItselfBehindTheLastScanIsUnsettledToo) {
  SourceLedger ledger;
  ledger.add(10, {5, 100, 4});
  SourceAccount heard = account(10, 100, true);
  heard.offset = 8;  // three of the four are known by the numbers
  EXPECT_EQ(ledger.unaccounted({heard}, true), 1U);
}

TEST(SourceLedger, LearnsFromOneReaderWhatNobodyTold) {
  SourceLedger ledger = ledger_of({100, 5});
  const std::vector<SourceAccount> knows{account(10, 130, true), account(20, 5)};
  const std::vector<SourceAccount> does_not{account(10, 70, true), account(20, 5)};
  ledger.learn({&knows, &does_not});
  EXPECT_EQ(ledger.published(), 135U);
  EXPECT_EQ(ledger.unaccounted(knows, true), 0U);
  EXPECT_EQ(ledger.unaccounted(does_not, true), 60U);
}

TEST(SourceLedger, LossesBehindTheLastScanMayBeOfAProcessThatWasNeverHeard) {
  SourceLedger ledger = ledger_of({100, 50, 7});
  const std::vector<SourceAccount> accounts{account(10, 140, true), account(30, 2)};
  ledger.learn({&accounts});
  EXPECT_EQ(ledger.published(), 157U);
  EXPECT_EQ(ledger.unaccounted(accounts, false), 10U);
}

TEST(SourceLedger, LearnsNothingTwice) {
  SourceLedger ledger = ledger_of({100, 5, 7});
  const std::vector<SourceAccount> wide{account(10, 120, true), account(30, 2)};
  const std::vector<SourceAccount> narrow{account(10, 100, true), account(20, 20), account(30, 2)};
  ledger.learn({&wide, &narrow});
  EXPECT_EQ(ledger.published(), 127U) << "the fifteen that both know of are the same";
}

TEST(SourceLedger, NobodyCanTellWhatWasLostBetweenSourcesThatAreNotComparable) {
  SourceLedger ledger = ledger_of({100, 50});
  EXPECT_EQ(ledger.unaccounted({account(10, 90, true), account(20, 5, true)}, false), 0U);
  SourceAccount handed_over = account(10, 90, true);
  handed_over.handed_over = true;
  EXPECT_EQ(ledger.unaccounted({handed_over, account(20, 5)}, false), 0U);
  EXPECT_EQ(ledger.unaccounted({account(15, 90, true)}, true), 0U) << "of another source";
}

TEST(SourceLedger, TellsWhatWasBeforeTheFirstScanThatArrived) {
  SourceLedger ledger;
  ledger.add(10, {0, 100, 1});
  ledger.add(20, {0, 50, 0});
  ledger.add(30, {50, 50, 0});  // with the numbers of the one before
  EXPECT_EQ(ledger.scans(), 201U);
  EXPECT_EQ(ledger.scans_before(10), 0U);
  EXPECT_EQ(ledger.scans_before(20), 101U);
  EXPECT_EQ(ledger.scans_before(30), 101U) << "the second one's are counted by numbers";
}

/// A source, a stage and two readers, each of which may fail at any time; results may be late.
class Accident {
 public:
  Accident(unsigned seed, std::int64_t latest) : random_(seed), latest_(latest) {}

  void run(int scans) {
    for (int i = 0; i < scans; ++i) {
      clock_ += 50'000'000;
      if (happens(0.01)) restart_source();
      if (happens(0.01)) stage_ = {now(), 0};
      deaf_source_ = happens(0.02) ? !deaf_source_ : deaf_source_;
      for (bool& deaf : deaf_readers_) deaf = happens(0.02) ? !deaf : deaf;
      publish();
      for (Reader& reader : readers_) reader.take(clock_);
    }
  }

  void judge(bool told) const {
    SourceLedger ledger;
    std::uint64_t published = 0;
    for (const auto& [incarnation, process] : sources_) {
      ledger.add(incarnation, told ? process.really : process.heard);
      published += process.really.published;
    }
    ledger.learn({&readers_[0].accounting.sources(), &readers_[1].accounting.sources()});
    EXPECT_LE(ledger.published(), published);
    if (told) {
      EXPECT_EQ(ledger.published(), published);
    }
    for (const Reader& reader : readers_) {
      ASSERT_FALSE(reader.accounting.sources().empty());
      const auto& accounts = reader.accounting.sources();
      EXPECT_EQ(reader.first + ledger.scans_before(accounts.front().incarnation) +
                    reader.accounting.received() + reader.accounting.lost() +
                    ledger.unaccounted(accounts, true),
                ledger.published());
    }
  }

 private:
  struct Source {
    SourceLedger::Process really;
    SourceLedger::Process heard;  // by heartbeats and results
  };
  struct Stage {
    std::uint64_t started;
    std::uint64_t made;
  };
  struct Reader {
    void take(std::int64_t now) {
      while (!on_the_way.empty() && on_the_way.begin()->first <= now) {
        const msg::Header& header = on_the_way.begin()->second;
        if (accounting.sources().empty()) first = topics::sequence_number(header);
        accounting.receive(header);
        on_the_way.erase(on_the_way.begin());
      }
    }

    ScanAccounting accounting;
    std::uint64_t first = 0;
    std::multimap<std::int64_t, msg::Header> on_the_way;  // by when they come
  };

  bool happens(double probability) {
    return std::uniform_real_distribution<double>(0.0, 1.0)(random_) < probability;
  }
  [[nodiscard]] std::uint64_t now() const { return static_cast<std::uint64_t>(clock_); }
  void restart_source() { sources_[now()]; }

  void publish() {
    auto& [incarnation, source] = *sources_.rbegin();
    msg::Header header;
    topics::set_origin(header, "front", incarnation, source.really.published);
    header.trace().resize(2);
    header.trace()[0].service("front");
    header.trace()[0].incarnation(incarnation);
    header.trace()[0].index(source.really.published++);
    header.trace()[0].published(clock_);
    if (!deaf_source_) source.heard.published = source.really.published;
    if (happens(0.1)) return;
    header.trace()[1].service("walls");
    header.trace()[1].incarnation(stage_.started);
    header.trace()[1].index(stage_.made++);
    header.trace()[1].published(clock_);
    for (std::size_t i = 0; i < readers_.size(); ++i) {
      if (deaf_readers_[i]) continue;
      const bool late = latest_ > 0 && happens(0.02);
      const std::int64_t delay =
          late ? std::uniform_int_distribution<std::int64_t>(0, latest_)(random_) : 0;
      readers_[i].on_the_way.emplace(clock_ + delay, header);
      source.heard.published =
          std::max<std::uint64_t>(source.heard.published, header.trace()[0].index() + 1);
    }
  }

  std::mt19937 random_;
  std::int64_t latest_;  // [ns]
  std::int64_t clock_ = 1'000'000'000;
  std::map<std::uint64_t, Source> sources_{{1'000'000'000, {}}};
  Stage stage_{1'000'000'000, 0};
  std::array<Reader, 2> readers_;
  bool deaf_source_ = false;
  std::array<bool, 2> deaf_readers_{};
};

TEST(SourceLedger, AccountsForEachScanWhateverFails) {
  for (unsigned seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE(seed);
    for (const std::int64_t latest : {0LL, 5'000'000'000LL, 50'000'000'000LL}) {
      SCOPED_TRACE(latest);
      Accident accident(seed, latest);
      accident.run(2000);
      accident.judge(true);
      accident.judge(false);
    }
  }
}

}  // namespace
}  // namespace quoin::runtime
