// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include <chrono>
#include <idl/Scan.h>
#include <string>
#include <thread>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "services/runtime/dds/endpoints.hpp"
#include "services/runtime/dds/participant.hpp"
#include "services/runtime/dds/qos.hpp"
#include "services/topics/header.hpp"
#include "tests/services/runtime/dds_test_scope.hpp"

namespace quoin::runtime {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;
using tests::test_domain;
using tests::test_namespace;

const std::string topic = test_namespace() + "/front/scan";

template <class Condition>
bool within(std::chrono::milliseconds timeout, const Condition& condition) {
  const auto deadline = Clock::now() + timeout;
  while (!condition()) {
    if (Clock::now() > deadline) return false;
    std::this_thread::sleep_for(1ms);
  }
  return true;
}

ParticipantConfig observing(const std::vector<std::string>& topics) {
  ParticipantConfig config{test_domain(), test_namespace() + "/echo"};
  config.observes = topics;
  return config;
}

/// Sequence numbers of the next `count` messages, or of those that came within ten seconds.
std::vector<std::uint64_t> take(Reader<msg::Scan>& reader, std::size_t count) {
  WaitSet wait_set;
  wait_set.add(reader);
  std::vector<std::uint64_t> numbers;
  msg::Scan scan;
  const auto deadline = Clock::now() + 10s;
  while (numbers.size() < count && Clock::now() < deadline) {
    while (reader.take(scan)) numbers.push_back(topics::sequence_number(scan.header()));
    if (numbers.size() < count) wait_set.wait(100ms);
  }
  return numbers;
}

std::vector<std::uint64_t> write(Writer<msg::Scan>& writer, std::uint64_t count) {
  std::vector<std::uint64_t> numbers;
  msg::Scan scan;
  const auto deadline = Clock::now() + 20s;
  for (std::uint64_t i = 0; i < count; ++i) {
    topics::set_origin(scan.header(), "front", 1, i);
    // False while its history is full of what is on its way.
    while (!writer.write(scan) && Clock::now() < deadline) {
    }
    numbers.push_back(i);
  }
  return numbers;
}

TEST(Observers, WhoWasThereBeforeAWriterHasAllThatItWrites) {
  Participant watching(observing({"another", topic}));
  Reader<msg::Scan> reader(watching, topic, QosPreset::observer);
  for (int start = 0; start < 20; ++start) {
    Participant serving({test_domain(), test_namespace() + "/front"});
    Writer<msg::Scan> writer(serving, topic, QosPreset::lossless);
    ASSERT_TRUE(within(
        10s, [&] { return serving.discovery_complete() && writer.awaited_observers().empty(); }));
    EXPECT_EQ(writer.matched(), 1U);
    const auto written = write(writer, 50);
    ASSERT_EQ(take(reader, written.size()), written) << start;
  }
}

TEST(Observers, AreAwaitedFromTheirAnnouncementUntilTheirReaderIsMatched) {
  Participant serving({test_domain(), test_namespace() + "/front"});
  Writer<msg::Scan> writer(serving, topic, QosPreset::lossless);
  Writer<msg::Scan> other(serving, topic + "s", QosPreset::lossless);
  Participant watching(observing({topic}));
  ASSERT_TRUE(within(10s, [&] { return !writer.awaited_observers().empty(); }));
  EXPECT_THAT(writer.awaited_observers(), testing::ElementsAre("echo"));
  EXPECT_THAT(other.awaited_observers(), testing::IsEmpty());
  Reader<msg::Scan> reader(watching, topic, QosPreset::observer);
  EXPECT_TRUE(within(10s, [&] { return writer.awaited_observers().empty(); }));
  EXPECT_EQ(writer.matched(), 1U);
}

TEST(Observers, AreNotAwaitedWhenTheirReaderDoesNotFit) {
  Participant serving({test_domain(), test_namespace() + "/front"});
  Writer<msg::Scan> writer(serving, topic, QosPreset::lossless);
  Participant watching(observing({topic}));
  ASSERT_TRUE(within(10s, [&] { return !writer.awaited_observers().empty(); }));
  Reader<msg::Scan> reader(watching, topic, QosPreset::state);
  EXPECT_TRUE(within(10s, [&] { return writer.awaited_observers().empty(); }));
  EXPECT_EQ(writer.matched(), 0U);
}

TEST(Observers, AreNotAwaitedOnceTheyHaveGone) {
  Participant serving({test_domain(), test_namespace() + "/front"});
  Writer<msg::Scan> writer(serving, topic, QosPreset::lossless);
  {
    Participant watching(observing({topic}));
    ASSERT_TRUE(within(10s, [&] { return !writer.awaited_observers().empty(); }));
  }
  EXPECT_TRUE(within(10s, [&] { return writer.awaited_observers().empty(); }));
}

TEST(Observers, NeverSlowAWriterDown) {
  Participant watching(observing({topic}));
  Reader<msg::Scan> reader(watching, topic, QosPreset::observer);
  Participant serving({test_domain(), test_namespace() + "/front"});
  Writer<msg::Scan> writer(serving, topic, QosPreset::lossless);
  ASSERT_TRUE(writer.wait_for_readers(1, 10s));
  // More than it holds while it does not take any.
  const auto written = write(writer, 6000);
  ASSERT_TRUE(writer.wait_for_acknowledgments(10s));
  EXPECT_EQ(take(reader, 4096), std::vector(written.end() - 4096, written.end()));
}

TEST(Observers, AnnounceThousandsOfTopicsWithinBounds) {
  Participant watching(observing(std::vector<std::string>(5000, topic)));
  Participant serving({test_domain(), test_namespace() + "/front"});
  Writer<msg::Scan> writer(serving, topic, QosPreset::lossless);
  EXPECT_TRUE(within(10s, [&] { return !writer.awaited_observers().empty(); }));
}

}  // namespace
}  // namespace quoin::runtime
