// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include <map>
#include <random>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "services/runtime/accounting/source_ledger.hpp"
#include "tests/services/runtime/node/requests.hpp"
#include "tests/services/runtime/node/stage.hpp"

namespace quoin::runtime {
namespace {

using Random = std::mt19937;

bool happens(Random& random, double probability) {
  return std::uniform_real_distribution<double>(0.0, 1.0)(random) < probability;
}

/// A service of a chain, with its processes one after the other. Reads In and writes Out.
template <class In, class Out>
class Service {
 public:
  Service(Random& random, std::string name, MemoryTopic<In>& from,
          std::shared_ptr<MemoryTopic<Out>> to)
      : random_(random), name_(std::move(name)), from_(from), to_(std::move(to)) {
    process_ = start(false);
  }

  /// Does some of what there is to do.
  void work() {
    while (happens(random_, 0.8) && process_->stage.node().step()) {
    }
  }
  void finish() { process_->stage.run(); }

  /// Dies with what it has received, and is started again.
  void restart() {
    std::erase(from_.readers, process_->queue);
    process_ = start(false);
  }

  void swap() {
    msg::ControlRequest request;
    request.action(msg::ControlAction::CONTROL_SWAP_METHOD);
    request.method(happens(random_, 0.5) ? "one" : "other");
    msg::ControlReply reply;
    process_->stage.node().exchange().handle(request, reply);
  }

  /// `publish` lets messages come, while the successor waits.
  template <class Publish>
  void replace(Publish publish) {
    auto successor = start(true);
    publish();
    successor->stage.run();
    const Positions from = positions_of(hold(successor->stage));
    publish();
    work();
    successor->stage.run();
    const msg::ControlReply left = hand_over(process_->stage, from);
    publish();
    (void)take_over(successor->stage, positions_of(left), left.state());
    std::erase(from_.readers, process_->queue);
    process_ = std::move(successor);
  }

  /// Of all messages that this process has accounted for.
  void judge() {
    const msg::ServiceStatus status = process_->stage.status();
    std::uint64_t lost = 0;
    for (const msg::LossCount& loss : status.losses()) {
      if (loss.cause() != "link") lost += loss.count();
    }
    EXPECT_EQ(status.received(), status.published() + lost) << name_;
  }

 private:
  struct Process {
    Process(Service& service, bool held)
        : queue(service.from_.subscribe()),
          stage({.service = service.name_,
                 .method = "one",
                 .held = held,
                 .longest_exchange = std::chrono::milliseconds(0)},
                always([&random = service.random_](Work&) {
                  if (happens(random, 0.02)) throw std::runtime_error("singular");
                }),
                outputs(output_part(service.to_))) {
      stage.node().open(inputs(input_part({"in", "type"}, "before", queue)));
    }
    std::shared_ptr<MemoryQueue<In>> queue;
    Stage stage;
  };
  std::unique_ptr<Process> start(bool held) { return std::make_unique<Process>(*this, held); }

  Random& random_;
  std::string name_;
  MemoryTopic<In>& from_;
  std::shared_ptr<MemoryTopic<Out>> to_;
  std::unique_ptr<Process> process_;
};

/// source -> walls -> wctls -> the one who counts. Everything that can fail does at times, but for
/// what is told of the source: a successor is handed over to while messages can reach it.
class History {
 public:
  explicit History(unsigned seed) : random_(seed) {
    segments_->room = lines_->room = [this] { return !happens(random_, 0.01); };
    const auto arrivals = [this](double lost, double doubled) {
      if (calm_) return 1;
      return happens(random_, lost) ? 0 : happens(random_, doubled) ? 2 : 1;
    };
    scans_.arrivals = [=](std::size_t) { return arrivals(0.03, 0.02); };
    segments_->arrivals = [=](std::size_t) { return arrivals(0.03, 0.02); };
    lines_->arrivals = [=, this](std::size_t) {
      const int count = arrivals(0.03, 0.02);
      if (count > 1) ++doubled_;
      return count;
    };
  }

  void run(int steps) {
    for (int i = 0; i < steps; ++i) {
      if (happens(random_, 0.005)) restart_source();
      if (happens(random_, 0.01)) walls_.restart();
      if (happens(random_, 0.01)) wctls_.restart();
      if (happens(random_, 0.02)) walls_.swap();
      if (happens(random_, 0.02)) wctls_.swap();
      publish();
      walls_.work();
      wctls_.work();
      if (happens(random_, 0.01)) replace(walls_, [this] { publish(); });
      if (happens(random_, 0.01)) {
        replace(wctls_, [this] {
          publish();
          walls_.finish();
        });
      }
      count();
    }
    walls_.finish();
    wctls_.finish();
    count();
    note_source();
  }

  void judge() {
    SourceLedger ledger;
    std::uint64_t published = 0;
    for (const auto& [incarnation, process] : sources_) {
      ledger.add(incarnation, process);
      published += process.published + process.lost;
    }
    ASSERT_FALSE(accounting_.sources().empty());
    ledger.learn({&accounting_.sources()});
    EXPECT_EQ(ledger.scans(), published);
    EXPECT_EQ(*accounting_.first_sequence() +
                  ledger.scans_before(accounting_.sources().front().incarnation) +
                  accounting_.received() + accounting_.lost() +
                  ledger.unaccounted(accounting_.sources(), true),
              published);
    EXPECT_EQ(accounting_.duplicates(), doubled_) << "no service has doubled anything";
    walls_.judge();
    wctls_.judge();
  }

 private:
  void publish() {
    if (happens(random_, 0.01)) {
      front_.lose();
      ++lost_;
      return;
    }
    scans_.publish(front_.next());
  }
  void restart_source() {
    note_source();
    front_.restart();
    lost_ = 0;
  }
  void note_source() { sources_[front_.incarnation()] = {0, front_.published(), lost_}; }
  template <class Replaced, class Publish>
  void replace(Replaced& service, Publish come) {
    // What is lost to the one and not to the other would be waited for in vain.
    calm_ = true;
    service.finish();
    service.replace(come);
    calm_ = false;
  }
  void count() {
    while (const auto message = end_->pop()) accounting_.receive(message->header());
  }

  Random random_;
  bool calm_ = false;
  Numbered<msg::Scan> front_{"front"};
  std::uint64_t lost_ = 0;  // by the present process of the source
  std::map<std::uint64_t, SourceLedger::Process> sources_;
  MemoryTopic<msg::Scan> scans_;
  std::shared_ptr<MemoryTopic<msg::Segments>> segments_ =
      std::make_shared<MemoryTopic<msg::Segments>>();
  std::shared_ptr<MemoryTopic<msg::Lines>> lines_ = std::make_shared<MemoryTopic<msg::Lines>>();
  std::shared_ptr<MemoryQueue<msg::Lines>> end_ = lines_->subscribe();
  Service<msg::Scan, msg::Segments> walls_{random_, "walls", scans_, segments_};
  Service<msg::Segments, msg::Lines> wctls_{random_, "wctls", *segments_, lines_};
  ScanAccounting accounting_;
  std::uint64_t doubled_ = 0;  // on the last link
};

TEST(RandomHistory, WhatIsDeliveredAndWhatIsLostAddUpToWhatWasPublished) {
  for (unsigned seed = 0; seed < 100; ++seed) {
    SCOPED_TRACE(seed);
    History history(seed);
    history.run(400);
    history.judge();
    if (testing::Test::HasFailure()) break;
  }
}

}  // namespace
}  // namespace quoin::runtime
