// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0

// The node's thread and the control thread at once: what ThreadSanitizer is to see.
#include <atomic>
#include <future>
#include <numeric>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/services/runtime/node/requests.hpp"
#include "tests/services/runtime/node/stage.hpp"

namespace quoin::runtime {
namespace {

using testing::ElementsAreArray;

/// A node in a thread of its own, which ends when it has left or is told to.
class RunningNode {
 public:
  RunningNode(MemoryTopic<msg::Scan>& scans, std::shared_ptr<MemoryTopic<msg::Segments>> results,
              bool held, MethodFactory make)
      : stage_({.service = "walls", .held = held}, std::move(make),
               outputs(output_part(std::move(results)))) {
    stage_.node().open(inputs(input_part({"scan", "scan"}, "front", scans.subscribe())));
    thread_ = std::thread([this] {
      while (!ending_ && !stage_.node().has_left()) {
        if (!stage_.node().step()) std::this_thread::yield();
      }
      if (stage_.node().has_left()) {
        stage_.node().leave();
      } else {
        stage_.node().drain();
      }
    });
  }
  ~RunningNode() { end(); }
  RunningNode(const RunningNode&) = delete;
  RunningNode& operator=(const RunningNode&) = delete;

  void end() {
    ending_ = true;
    if (thread_.joinable()) thread_.join();
  }
  [[nodiscard]] Stage& stage() { return stage_; }

 private:
  Stage stage_;
  std::atomic<bool> ending_{false};
  std::thread thread_;
};

/// Publishes as long as it lives.
class RunningSource {
 public:
  explicit RunningSource(MemoryTopic<msg::Scan>& scans) : scans_(scans) {
    thread_ = std::thread([this] {
      while (!ending_) {
        scans_.publish(front_.next());
        std::this_thread::yield();
      }
    });
  }
  ~RunningSource() { (void)end(); }
  /// How many it has published.
  std::uint64_t end() {
    ending_ = true;
    if (thread_.joinable()) thread_.join();
    return front_.published();
  }

 private:
  MemoryTopic<msg::Scan>& scans_;
  Numbered<msg::Scan> front_{"front"};
  std::atomic<bool> ending_{false};
  std::thread thread_;
};

std::vector<std::uint64_t> up_to(std::uint64_t count) {
  std::vector<std::uint64_t> numbers(count);
  std::iota(numbers.begin(), numbers.end(), 0);
  return numbers;
}

MethodFactory counting() {
  return [](const std::string&, const ParameterSettings&) {
    const auto count = std::make_shared<std::uint32_t>(0);
    return Method{
        .handle = [count](Work& work) { work.output<msg::Segments>().scan_points((*count)++); },
        .state_form = "count/1",
        .save =
            [count] {
              const std::string text = std::to_string(*count);
              return State(text.begin(), text.end());
            },
        .restore =
            [count](const State& state) {
              *count =
                  static_cast<std::uint32_t>(std::stoul(std::string(state.begin(), state.end())));
            }};
  };
}

void expect_all(const std::vector<msg::Segments>& results, std::uint64_t published) {
  ASSERT_THAT(numbers(results), ElementsAreArray(up_to(published)));
  for (std::size_t i = 0; i < results.size(); ++i) {
    ASSERT_EQ(results[i].scan_points(), i) << "the state has gone over";
  }
}

TEST(NodeThreads, MethodsAreExchangedWhileMessagesCome) {
  MemoryTopic<msg::Scan> scans;
  const auto results = std::make_shared<MemoryTopic<msg::Segments>>();
  RunningNode walls(scans, results, false, counting());
  RunningSource front(scans);
  for (int i = 0; i < 50; ++i) {
    msg::ControlRequest request = request_to(msg::ControlAction::CONTROL_SWAP_METHOD);
    request.method(i % 2 == 0 ? "one" : "other");
    msg::ControlReply reply;
    walls.stage().node().exchange().handle(request, reply);
    EXPECT_TRUE(reply.accepted());
    EXPECT_EQ(reply.detail(), "");
    (void)walls.stage().status();  // as a heartbeat does
  }
  const std::uint64_t published = front.end();
  walls.end();
  expect_all(results->written, published);
}

TEST(NodeThreads, TheWorkGoesFromOneToTheNextWhileMessagesCome) {
  MemoryTopic<msg::Scan> scans;
  const auto first_results = std::make_shared<MemoryTopic<msg::Segments>>();
  const auto second_results = std::make_shared<MemoryTopic<msg::Segments>>();
  RunningNode first(scans, first_results, false, counting());
  RunningNode second(scans, second_results, true, counting());
  RunningSource front(scans);
  msg::ControlReply held;
  while (held.held_scans() == 0) held = hold(second.stage());
  const msg::ControlReply left =
      answer(first.stage(), request_to(msg::ControlAction::CONTROL_HAND_OVER, positions_of(held)));
  EXPECT_TRUE(first.stage().status().outputs()[0].published() >= held.first_sequence_number());
  (void)take_over(second.stage(), positions_of(left), left.state());
  while (second.stage().status().published() < 20) std::this_thread::yield();
  const std::uint64_t published = front.end();
  second.end();
  first.end();
  std::vector<msg::Segments> results = first_results->written;
  results.insert(results.end(), second_results->written.begin(), second_results->written.end());
  expect_all(results, published);
}

}  // namespace
}  // namespace quoin::runtime
