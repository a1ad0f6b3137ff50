// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <atomic>
#include <chrono>
#include <idl/Corners.h>
#include <idl/Scan.h>
#include <idl/Segments.h>
#include <idl/Status.h>
#include <memory>
#include <numeric>
#include <thread>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "services/runtime/dds/endpoints.hpp"
#include "services/runtime/dds/participant.hpp"
#include "services/runtime/dds/qos.hpp"
#include "services/topics/header.hpp"
#include "services/topics/type_digest.hpp"
#include "tests/services/runtime/dds_test_scope.hpp"
#include "tests/services/runtime/heap.hpp"

namespace quoin::runtime {
namespace {

using namespace std::chrono_literals;
using tests::test_domain;
using tests::test_namespace;

msg::Scan scan_of(std::size_t points, std::uint64_t sequence_number) {
  msg::Scan scan;
  topics::set_origin(scan.header(), "front", 1, sequence_number);
  scan.bearings().resize(points);
  scan.ranges().resize(points);
  std::iota(scan.ranges().begin(), scan.ranges().end(), 1.0F);
  return scan;
}

/// Waits until the reader gave a message; false after ten seconds.
template <class T>
bool take_within(Reader<T>& reader, T& message, std::chrono::milliseconds timeout = 10s) {
  WaitSet wait_set;
  wait_set.add(reader);
  const auto deadline = std::chrono::steady_clock::now() + timeout;
  while (std::chrono::steady_clock::now() < deadline) {
    if (reader.take(message)) return true;
    wait_set.wait(100ms);
  }
  return false;
}

TEST(Topics, AScanArrivesAsItWasSent) {
  Participant sender({test_domain(), "sender"});
  Participant receiver({test_domain(), "receiver"});
  Writer<msg::Scan> writer(sender, test_namespace() + "/front/scan", QosPreset::sensor);
  Reader<msg::Scan> reader(receiver, test_namespace() + "/front/scan", QosPreset::sensor);
  ASSERT_TRUE(writer.wait_for_readers(1, 10s));
  ASSERT_TRUE(reader.wait_for_writers(1, 10s));
  const msg::Scan sent = scan_of(1000, 42);
  ASSERT_TRUE(writer.write(sent));
  msg::Scan got;
  ASSERT_TRUE(take_within(reader, got));
  EXPECT_EQ(topics::sequence_number(got.header()), 42U);
  EXPECT_EQ(got.ranges(), sent.ranges());
  EXPECT_FALSE(reader.take(got));
}

TEST(Topics, ScansThatWaitForTheirReaderTakeNoMoreMemoryThanTheyNeed) {
  if (!tests::heap_is_visible())
    GTEST_SKIP() << "this process has another heap than that of the C library";
  Participant sender({test_domain(), "sender"});
  Participant receiver({test_domain(), "receiver"});
  Writer<msg::Corners> writer(sender, test_namespace() + "/corners/corners", QosPreset::feature);
  Reader<msg::Corners> reader(receiver, test_namespace() + "/corners/corners", QosPreset::feature);
  ASSERT_TRUE(writer.wait_for_readers(1, 10s));
  msg::Corners corners;
  corners.corners().resize(10);
  for (msg::Corner& corner : corners.corners()) {
    corner.covariance_xx(1e-6);
    corner.covariance_yy(1e-6);
  }
  ASSERT_TRUE(writer.write(corners));
  ASSERT_TRUE(writer.wait_for_acknowledgments(10s));
  const std::size_t before = tests::heap_in_use();
  constexpr std::size_t waiting = 30;
  for (std::size_t i = 0; i < waiting; ++i) ASSERT_TRUE(writer.write(corners));
  ASSERT_TRUE(writer.wait_for_acknowledgments(10s));
  // Of some 1.1 kB that one takes in the history of the reader; a hundred corners would be 66 kB.
  EXPECT_LT(tests::heap_in_use(), before + waiting * 8000U);
  std::size_t taken = 0;
  while (reader.take(corners)) ++taken;
  EXPECT_EQ(taken, waiting + 1);
}

TEST(Topics, AScanLargerThanADatagramArrives) {
  Participant sender({test_domain(), "sender"});
  Participant receiver({test_domain(), "receiver"});
  Writer<msg::Scan> writer(sender, test_namespace() + "/front/scan", QosPreset::sensor);
  Reader<msg::Scan> reader(receiver, test_namespace() + "/front/scan", QosPreset::sensor);
  ASSERT_TRUE(writer.wait_for_readers(1, 10s));
  const msg::Scan sent = scan_of(100'000, 1);
  ASSERT_TRUE(writer.write(sent));
  msg::Scan got;
  ASSERT_TRUE(take_within(reader, got));
  EXPECT_EQ(got.ranges(), sent.ranges());
}

TEST(Topics, LosslessWaitsForASlowReader) {
  Participant sender({test_domain(), "sender"});
  Participant receiver({test_domain(), "receiver"});
  Writer<msg::Scan> writer(sender, test_namespace() + "/front/scan", QosPreset::lossless);
  Reader<msg::Scan> reader(receiver, test_namespace() + "/front/scan", QosPreset::lossless);
  ASSERT_TRUE(writer.wait_for_readers(1, 10s));
  constexpr std::uint64_t count = 1000;  // far more than both histories hold
  std::atomic<bool> given_up = false;
  std::thread sending([&] {
    for (std::uint64_t i = 0; i < count; ++i) {
      while (!writer.write(scan_of(900, i)) && !given_up) {
      }
    }
  });
  msg::Scan got;
  std::uint64_t expected = 0;
  while (expected < count && take_within(reader, got)) {
    ASSERT_EQ(topics::sequence_number(got.header()), expected);
    ++expected;
  }
  EXPECT_EQ(expected, count);
  given_up = true;
  sending.join();
}

TEST(Topics, SensorPresetNeverWaitsForASlowReader) {
  Participant sender({test_domain(), "sender"});
  Participant receiver({test_domain(), "receiver"});
  Writer<msg::Scan> writer(sender, test_namespace() + "/front/scan", QosPreset::sensor);
  Reader<msg::Scan> reader(receiver, test_namespace() + "/front/scan", QosPreset::sensor);
  ASSERT_TRUE(writer.wait_for_readers(1, 10s));
  for (std::uint64_t i = 0; i < 200; ++i) ASSERT_TRUE(writer.write(scan_of(900, i)));
  ASSERT_TRUE(writer.wait_for_acknowledgments(10s));
  msg::Scan got;
  std::uint64_t taken = 0;
  while (reader.take(got)) ++taken;
  EXPECT_LE(taken, 5U) << "keeps the last five";
  EXPECT_EQ(topics::sequence_number(got.header()), 199U) << "and the newest of all";
}

TEST(Topics, StateReachesALateReaderOnceForEachService) {
  Participant sender({test_domain(), "sender"});
  Writer<msg::ServiceStatus> writer(sender, test_namespace() + "/status", QosPreset::state);
  constexpr int services = 40;  // more than Fast DDS allows without set limits
  for (int round = 0; round < 3; ++round) {
    for (int i = 0; i < services; ++i) {
      msg::ServiceStatus status;
      status.service("service_" + std::to_string(i));
      status.received(static_cast<std::uint64_t>(round));
      ASSERT_TRUE(writer.write(status)) << i;
    }
  }
  Participant receiver({test_domain(), "receiver"});
  Reader<msg::ServiceStatus> reader(receiver, test_namespace() + "/status", QosPreset::state);
  std::vector<std::string> seen;
  msg::ServiceStatus status;
  while (seen.size() < services && take_within(reader, status)) {
    EXPECT_EQ(status.received(), 2U) << "the latest only";
    seen.push_back(status.service());
  }
  std::sort(seen.begin(), seen.end());
  EXPECT_EQ(std::unique(seen.begin(), seen.end()) - seen.begin(), services);
}

TEST(Topics, AQosMismatchIsToldToBothSides) {
  Participant sender({test_domain(), "sender"});
  Participant receiver({test_domain(), "receiver"});
  const std::string topic = test_namespace() + "/front/scan";
  Writer<msg::Scan> writer(sender, topic, QosPreset::sensor);   // volatile
  Reader<msg::Scan> reader(receiver, topic, QosPreset::state);  // asks for transient-local
  const auto deadline = std::chrono::steady_clock::now() + 10s;
  while ((writer.incompatible_qos().empty() || reader.incompatible_qos().empty()) &&
         std::chrono::steady_clock::now() < deadline) {
    std::this_thread::yield();
  }
  const std::string text =
      topic + ": durability: sender offers volatile, receiver requests transient-local";
  EXPECT_THAT(writer.incompatible_qos(), testing::ElementsAre(text));
  EXPECT_THAT(reader.incompatible_qos(), testing::ElementsAre(text));
  EXPECT_EQ(writer.matched(), 0U);
}

TEST(Topics, ATypeWithOtherFieldsIsRefusedByName) {
  Participant sender({test_domain(), "sender"});
  Participant receiver({test_domain(), "receiver"});
  const std::string topic = test_namespace() + "/front/scan";
  TopicQos of_another_version = QosPreset::feature;
  of_another_version.user_data = "quoin type 0badf00d;";
  const auto write = [&](Writer<msg::Scan>& writer, std::uint64_t number) {
    ASSERT_TRUE(writer.wait_for_readers(2, 10s));
    ASSERT_TRUE(writer.write(scan_of(10, number)));
    ASSERT_TRUE(writer.wait_for_acknowledgments(10s));
  };
  Reader<msg::Scan> reader(receiver, topic, QosPreset::feature);
  RawReader raw(receiver, topic, "quoin::msg::Scan", QosPreset::feature);
  Writer<msg::Scan> other(sender, topic, of_another_version);
  write(other, 1);
  msg::Scan got;
  topics::RawMessage bytes;
  while (reader.refused().empty()) ASSERT_FALSE(reader.take(got));
  while (raw.refused().empty()) ASSERT_FALSE(raw.take(bytes));
  EXPECT_THAT(reader.refused(), testing::ElementsAre(testing::Pair(
                                    "type: of another version, with other fields", 1U)));
  const auto names_both = testing::AllOf(
      testing::StartsWith(topic +
                          ": type: sender offers quoin::msg::Scan with the fields 0badf00d,"),
      testing::HasSubstr("receiver requests quoin::msg::Scan with the fields " +
                         std::string(topics::type_digest("quoin::msg::Scan"))));
  EXPECT_THAT(reader.incompatible_qos(), testing::ElementsAre(names_both));
  EXPECT_THAT(other.incompatible_qos(), testing::ElementsAre(names_both));
  // One of the same version beside it is heard.
  Writer<msg::Scan> same(sender, topic, QosPreset::feature);
  write(same, 2);
  ASSERT_TRUE(take_within(reader, got));
  EXPECT_EQ(topics::sequence_number(got.header()), 2U);
}

TEST(Topics, AMisfitIsForgottenWithItsParticipant) {
  Participant sender({test_domain(), test_namespace() + "/sender"});
  const std::string topic = test_namespace() + "/front/scan";
  TopicQos exclusive = QosPreset::sensor;
  exclusive.strength = 1;
  Writer<msg::Scan> writer(sender, topic, exclusive);
  {
    Participant receiver({test_domain(), test_namespace() + "/receiver"});
    Reader<msg::Scan> shared(receiver, topic, QosPreset::sensor);
    Reader<msg::Segments> other(receiver, topic + "s", exclusive);
    while (writer.incompatible_qos().empty()) std::this_thread::yield();
    EXPECT_THAT(writer.incompatible_qos(),
                testing::ElementsAre(
                    topic + ": ownership: sender offers exclusive, receiver requests shared"));
    while (receiver.written_topics() != std::vector{topic}) std::this_thread::yield();
  }
  while (!writer.incompatible_qos().empty()) std::this_thread::yield();
}

TEST(Topics, OfSeveralWritersTheStrongestThatLivesIsHeard) {
  Participant sender({test_domain(), "sender"});
  Participant receiver({test_domain(), "receiver"});
  const std::string topic = test_namespace() + "/front/scan";
  TopicQos weak = QosPreset::feature;
  weak.strength = 1;
  weak.lease = 200ms;
  TopicQos strong = weak;
  strong.strength = 2;
  Reader<msg::Scan> reader(receiver, topic, weak);
  Writer<msg::Scan> standby(sender, topic, weak);
  auto first = std::make_unique<Writer<msg::Scan>>(sender, topic, strong);
  ASSERT_TRUE(reader.wait_for_writers(2, 10s));
  ASSERT_TRUE(standby.wait_for_readers(1, 10s));
  ASSERT_TRUE(first->wait_for_readers(1, 10s));
  msg::Scan got;
  const auto heard = [&](Writer<msg::Scan>& writer, std::uint64_t number,
                         std::chrono::milliseconds timeout = 10s) {
    EXPECT_TRUE(writer.write(scan_of(900, number)));
    while (take_within(reader, got, timeout)) {
      if (topics::sequence_number(got.header()) == number) return true;
    }
    return false;
  };
  EXPECT_TRUE(heard(standby, 1)) << "nobody stronger has spoken yet";
  EXPECT_TRUE(heard(*first, 2));
  // A pause as long as a lease would let the standby through, so it may take several attempts.
  std::uint64_t next = 3;
  for (bool alone = false; !alone; next += 3) {
    EXPECT_TRUE(first->write(scan_of(900, next)));
    EXPECT_TRUE(standby.write(scan_of(900, next + 1)));
    first->assert_liveliness();
    EXPECT_TRUE(first->write(scan_of(900, next + 2)));
    alone = true;
    while (topics::sequence_number(got.header()) != next + 2) {
      ASSERT_TRUE(take_within(reader, got));
      alone = alone && topics::sequence_number(got.header()) != next + 1;
    }
  }
  // Silent, it is replaced; then it is heard again, until it goes.
  while (!heard(standby, next, 50ms)) ++next;
  EXPECT_TRUE(heard(*first, ++next));
  first.reset();
  while (!heard(standby, next, 50ms)) ++next;
}

TEST(Topics, WaitSetWakesUp) {
  Participant receiver({test_domain(), "receiver"});
  Reader<msg::Scan> reader(receiver, test_namespace() + "/front/scan", QosPreset::sensor);
  WaitSet wait_set;
  wait_set.add(reader);
  std::thread waking([&] { wait_set.wake(); });
  EXPECT_TRUE(wait_set.wait(10s));
  waking.join();
}

TEST(Topics, UnknownPresetIsRefused) {
  EXPECT_EQ(qos_preset("lossless"), QosPreset::lossless);
  EXPECT_THROW((void)qos_preset("best"), std::invalid_argument);
}

}  // namespace
}  // namespace quoin::runtime
