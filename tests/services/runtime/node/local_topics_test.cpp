// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/runtime/node/local_topics.hpp"

#include <atomic>
#include <memory>
#include <numeric>
#include <thread>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/services/runtime/node/stage.hpp"

namespace quoin::runtime {
namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;
using testing::ElementsAreArray;
using testing::IsEmpty;

Message message_of(const msg::Scan& scan) {
  const auto data = std::make_shared<const msg::Scan>(scan);
  return {data, &typeid(msg::Scan), &data->header()};
}

std::vector<std::uint64_t> take_all(Input& input) {
  std::vector<std::uint64_t> numbers;
  while (const auto message = input.take()) {
    numbers.push_back(topics::sequence_number(*message->header));
  }
  return numbers;
}

LocalInput reader_of(const std::shared_ptr<LocalTopic>& topic, QueueLimit limit = {},
                     std::function<void()> on_message = nullptr) {
  return {topic, "reader", limit, std::move(on_message)};
}

TEST(LocalTopics, AllReadersGetTheSameMessageAndNobodyCopiesIt) {
  LocalTopics topics;
  const auto topic = topics.topic("test/front/scan");
  EXPECT_EQ(topics.topic("test/front/scan"), topic);
  LocalInput one = reader_of(topic);
  LocalInput other = reader_of(topic);
  EXPECT_EQ(topic->readers(), 2U);
  Numbered<msg::Scan> front("front");
  const Message message = message_of(front.next());
  topic->publish(message);
  EXPECT_EQ(one.take()->data, message.data);
  EXPECT_EQ(other.take()->data, message.data);
  EXPECT_EQ(one.take(), std::nullopt);
}

TEST(LocalTopics, AReaderIsMatchedWhileThereIsAWriter) {
  const auto topic = std::make_shared<LocalTopic>();
  const LocalInput reader = reader_of(topic);
  EXPECT_EQ(reader.matched(), 0U);
  topic->open(17);
  EXPECT_EQ(reader.matched(), 1U);
  topic->close();
  EXPECT_EQ(reader.matched(), 0U);
}

TEST(LocalTopics, ASlowReaderLosesTheOldestMessages) {
  const auto topic = std::make_shared<LocalTopic>();
  LocalInput reader = reader_of(topic, {.depth = 3});
  Numbered<msg::Scan> front("front");
  for (int i = 0; i < 5; ++i) topic->publish(message_of(front.next()));
  EXPECT_TRUE(topic->wait_for_room(0ms)) << "it never waits";
  EXPECT_THAT(take_all(reader), ElementsAre(2, 3, 4));
}

TEST(LocalTopics, ALosslessReaderKeepsTheWriterWaiting) {
  const auto topic = std::make_shared<LocalTopic>();
  LocalInput reader = reader_of(topic, {.depth = 2, .lossless = true});
  Numbered<msg::Scan> front("front");
  for (int i = 0; i < 2; ++i) {
    ASSERT_TRUE(topic->wait_for_room(0ms));
    topic->publish(message_of(front.next()));
  }
  EXPECT_FALSE(topic->wait_for_room(0ms));
  EXPECT_THAT(topic->full_readers(), ElementsAre("reader"));
  EXPECT_THAT(take_all(reader), ElementsAre(0, 1));
  EXPECT_TRUE(topic->wait_for_room(0ms));
  EXPECT_THAT(topic->full_readers(), IsEmpty());
}

TEST(LocalTopics, NobodyWaitsForAReaderThatHasGone) {
  const auto topic = std::make_shared<LocalTopic>();
  Numbered<msg::Scan> front("front");
  auto reader = std::make_unique<LocalInput>(topic, "reader",
                                             QueueLimit{.depth = 1, .lossless = true}, nullptr);
  topic->publish(message_of(front.next()));
  std::thread writer([&] { EXPECT_TRUE(topic->wait_for_room(1h)); });
  reader.reset();
  writer.join();
  EXPECT_TRUE(topic->empty());
}

TEST(LocalTopics, NothingIsLostBetweenThreads) {
  const auto topic = std::make_shared<LocalTopic>();
  std::atomic<int> woken{0};
  LocalInput reader = reader_of(topic, {.depth = 8, .lossless = true}, [&] { ++woken; });
  constexpr std::uint64_t count = 5000;
  std::thread writer([&] {
    Numbered<msg::Scan> front("front");
    for (std::uint64_t i = 0; i < count; ++i) {
      while (!topic->wait_for_room(1s)) {
      }
      topic->publish(message_of(front.next()));
    }
  });
  std::vector<std::uint64_t> received;
  while (received.size() < count) {
    const auto message = reader.take();
    if (message) received.push_back(topics::sequence_number(*message->header));
  }
  writer.join();
  std::vector<std::uint64_t> all(count);
  std::iota(all.begin(), all.end(), 0);
  EXPECT_THAT(received, ElementsAreArray(all));
  EXPECT_EQ(woken, static_cast<int>(count));
}

/// A service that takes over together with its neighbour, whose messages it gets by DDS, too, until
/// it has closed that.
class TakeOver : public testing::Test {
 protected:
  TakeOver() {
    auto neighbour = std::make_unique<LocalInput>(topic_, "wctls", QueueLimit{}, nullptr);
    input_ = std::make_unique<TakeOverInput>(std::move(neighbour),
                                             std::make_unique<MemoryInput<msg::Scan>>(dds_),
                                             [this] { closed_ = true; });
  }
  void publish(const msg::Scan& scan) {
    if (!closed_) dds_->push(scan);
    topic_->publish(message_of(scan));
  }

  std::shared_ptr<LocalTopic> topic_ = std::make_shared<LocalTopic>();
  std::shared_ptr<MemoryQueue<msg::Scan>> dds_ = std::make_shared<MemoryQueue<msg::Scan>>();
  bool closed_ = false;
  std::unique_ptr<TakeOverInput> input_;
};

TEST_F(TakeOver, ReadsTheProcessBeforeUntilTheNeighbourBegins) {
  Numbered<msg::Scan> before("front");
  for (int i = 0; i < 3; ++i) dds_->push(before.next());
  EXPECT_EQ(topic_->readers(), 0U) << "it is counted by DDS";
  EXPECT_THAT(take_all(*input_), ElementsAre(0, 1, 2));
  dds_->push(before.next());
  Numbered<msg::Scan> neighbour("front");
  for (int i = 0; i < 4; ++i) neighbour.lose();
  topic_->open(neighbour.incarnation());
  publish(neighbour.next());
  EXPECT_THAT(take_all(*input_), ElementsAre(3, 4)) << "what came before, then each once";
  EXPECT_TRUE(closed_);
  EXPECT_EQ(topic_->readers(), 1U);
  publish(neighbour.next());
  EXPECT_THAT(take_all(*input_), ElementsAre(5));
}

TEST_F(TakeOver, IsMatchedWithTheProcessBeforeFirst) {
  dds_->writers = 0;
  topic_->open(17);
  EXPECT_EQ(input_->matched(), 0U);
  Numbered<msg::Scan> neighbour("front");
  publish(neighbour.next());
  (void)take_all(*input_);
  EXPECT_EQ(input_->matched(), 1U);
}

}  // namespace
}  // namespace quoin::runtime
