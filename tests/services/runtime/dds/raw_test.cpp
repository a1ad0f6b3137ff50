// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include <chrono>
#include <idl/LineMap.h>
#include <idl/Scan.h>
#include <idl/Segments.h>
#include <idl/Status.h>
#include <memory>
#include <set>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>

#include "services/runtime/dds/endpoints.hpp"
#include "services/runtime/dds/participant.hpp"
#include "services/runtime/dds/qos.hpp"
#include "services/topics/cdr_codec.hpp"
#include "services/topics/header.hpp"
#include "tests/services/runtime/dds_test_scope.hpp"

namespace quoin::runtime {
namespace {

using namespace std::chrono_literals;
using tests::test_domain;
using tests::test_namespace;
using topics::RawMessage;

const std::string scan_type = "quoin::msg::Scan";

msg::Scan scan_of(std::size_t points, std::uint64_t sequence_number) {
  msg::Scan scan;
  topics::set_origin(scan.header(), "front", 1, sequence_number);
  scan.bearings().resize(points);
  scan.ranges().assign(points, 2.5F);
  return scan;
}

template <class R, class M>
bool take_within(R& reader, M& message, std::chrono::milliseconds timeout = 10s) {
  WaitSet wait_set;
  wait_set.add(reader);
  const auto deadline = std::chrono::steady_clock::now() + timeout;
  while (std::chrono::steady_clock::now() < deadline) {
    if (reader.take(message)) return true;
    wait_set.wait(100ms);
  }
  return false;
}

TEST(Raw, ARawReaderGetsTheBytesOfATypedWriter) {
  Participant sender({test_domain(), "sender"});
  Participant receiver({test_domain(), "receiver"});
  const std::string topic = test_namespace() + "/front/scan";
  Writer<msg::Scan> writer(sender, topic, QosPreset::sensor);
  RawReader reader(receiver, topic, scan_type, QosPreset::sensor);
  ASSERT_TRUE(writer.wait_for_readers(1, 10s));
  const auto before = std::chrono::system_clock::now().time_since_epoch() / 1ns;
  const msg::Scan sent = scan_of(1000, 42);
  ASSERT_TRUE(writer.write(sent));
  RawMessage got;
  ASSERT_TRUE(take_within(reader, got));
  RawMessage expected;
  topics::encode(sent, expected);
  EXPECT_EQ(got.cdr, expected.cdr);
  const auto after = std::chrono::system_clock::now().time_since_epoch() / 1ns;
  // DDS keeps fractions of seconds as multiples of 2^-32 s.
  EXPECT_GE(got.published, before - 1);
  EXPECT_GE(got.received, got.published - 1);
  EXPECT_LE(got.received, after + 1);
  msg::Header header;
  ASSERT_TRUE(topics::read_header(got, header));
  EXPECT_EQ(topics::sequence_number(header), 42U);
  msg::Scan decoded;
  ASSERT_TRUE(topics::decode(got, decoded));
  EXPECT_TRUE(decoded == sent);
  EXPECT_FALSE(reader.take(got));
}

TEST(Raw, ASampleSaysWhichWriterItIsOfAndWhichOfItsSamples) {
  Participant sender({test_domain(), "sender"});
  Participant receiver({test_domain(), "receiver"});
  const std::string topic = test_namespace() + "/front/scan";
  Writer<msg::Scan> first(sender, topic, QosPreset::sensor);
  Writer<msg::Scan> second(sender, topic, QosPreset::sensor);
  RawReader reader(receiver, topic, scan_type, QosPreset::sensor);
  ASSERT_TRUE(first.wait_for_readers(1, 10s));
  ASSERT_TRUE(second.wait_for_readers(1, 10s));
  RawMessage got;
  const auto sample_of = [&](Writer<msg::Scan>& writer) {
    EXPECT_TRUE(writer.write(scan_of(1, 0)));
    EXPECT_TRUE(take_within(reader, got));
    return reader.last_sample();
  };
  const auto a = sample_of(first);
  const auto b = sample_of(second);
  const auto c = sample_of(first);
  EXPECT_NE(a.writer, b.writer);
  EXPECT_EQ(a.writer, c.writer);
  EXPECT_EQ(b.sequence_number, 1U);
  EXPECT_EQ(c.sequence_number, 2U);
}

TEST(Raw, ATypedReaderGetsTheMessageOfARawWriter) {
  Participant sender({test_domain(), "sender"});
  Participant receiver({test_domain(), "receiver"});
  const std::string topic = test_namespace() + "/front/scan";
  RawWriter writer(sender, topic, scan_type, QosPreset::sensor);
  Reader<msg::Scan> reader(receiver, topic, QosPreset::sensor);
  ASSERT_TRUE(writer.wait_for_readers(1, 10s));
  const msg::Scan sent = scan_of(1000, 7);
  RawMessage raw;
  topics::encode(sent, raw);
  ASSERT_TRUE(writer.write(raw));
  msg::Scan got;
  ASSERT_TRUE(take_within(reader, got));
  EXPECT_TRUE(got == sent);
}

TEST(Raw, WhatIsNoMessageOfTheTypeIsNotDelivered) {
  Participant sender({test_domain(), "sender"});
  Participant receiver({test_domain(), "receiver"});
  const std::string topic = test_namespace() + "/front/scan";
  RawWriter writer(sender, topic, scan_type, QosPreset::sensor);
  Reader<msg::Scan> reader(receiver, topic, QosPreset::sensor);
  ASSERT_TRUE(writer.wait_for_readers(1, 10s));
  RawMessage raw;
  EXPECT_FALSE(writer.write(raw)) << "not even an encapsulation header";
  raw.cdr = {std::byte{0}, std::byte{1}, std::byte{0}, std::byte{0}, std::byte{255}};
  EXPECT_TRUE(writer.write(raw));
  topics::encode(scan_of(10, 1), raw);
  raw.cdr[0] = std::byte{9};
  EXPECT_FALSE(writer.write(raw)) << "an unknown representation";
  raw.cdr[0] = std::byte{0};
  EXPECT_TRUE(writer.write(raw));
  msg::Scan got;
  ASSERT_TRUE(take_within(reader, got));
  EXPECT_EQ(topics::sequence_number(got.header()), 1U);
}

TEST(Raw, BytesOfAnUnknownTypeOfAnyLengthAreFilledUp) {
  Participant sender({test_domain(), "sender"});
  Participant receiver({test_domain(), "receiver"});
  const std::string topic = test_namespace() + "/stranger";
  RawWriter writer(sender, topic, "strange::Type_", QosPreset::feature);
  RawReader reader(receiver, topic, "strange::Type_", QosPreset::feature);
  ASSERT_TRUE(writer.wait_for_readers(1, 10s));
  RawMessage got;
  for (std::size_t size = 4; size < 5000; size += 997) {
    RawMessage raw;
    raw.cdr.assign(size, std::byte{1});
    raw.cdr[0] = std::byte{0};  // big endian is not touched, either
    raw.cdr[1] = std::byte(size % 2);
    ASSERT_TRUE(writer.write(raw));
    raw.cdr.resize((size + 3) / 4 * 4);
    ASSERT_TRUE(take_within(reader, got));
    EXPECT_EQ(got.cdr, raw.cdr);
  }
}

TEST(Raw, TypedAndRawEndpointsShareAParticipantInEitherOrder) {
  for (const bool raw_first : {false, true}) {
    Participant participant({test_domain(), "one"});
    Participant other({test_domain(), "other"});
    const std::string topic = test_namespace() + "/front/scan";
    std::unique_ptr<RawReader> raw_reader;
    std::unique_ptr<Reader<msg::Scan>> typed_reader;
    const auto make_raw = [&] {
      raw_reader = std::make_unique<RawReader>(participant, topic, scan_type, QosPreset::sensor);
    };
    if (raw_first) make_raw();
    typed_reader = std::make_unique<Reader<msg::Scan>>(participant, topic, QosPreset::sensor);
    if (!raw_first) make_raw();
    Writer<msg::Scan> own(participant, topic, QosPreset::sensor);
    RawWriter theirs(other, topic, scan_type, QosPreset::sensor);
    ASSERT_TRUE(own.wait_for_readers(2, 10s));
    ASSERT_TRUE(theirs.wait_for_readers(2, 10s));
    const msg::Scan sent = scan_of(100, 3);
    RawMessage raw;
    topics::encode(sent, raw);
    for (int i = 0; i < 2; ++i) {
      ASSERT_TRUE(i == 0 ? own.write(sent) : theirs.write(raw));
      msg::Scan typed;
      RawMessage bytes;
      ASSERT_TRUE(take_within(*typed_reader, typed));
      ASSERT_TRUE(take_within(*raw_reader, bytes));
      EXPECT_TRUE(typed == sent);
      EXPECT_EQ(bytes.cdr, raw.cdr);
    }
  }
}

TEST(Raw, ATopicHasOneTypeInAParticipant) {
  Participant participant({test_domain(), "one"});
  const std::string topic = test_namespace() + "/front/scan";
  const Reader<msg::Scan> reader(participant, topic, QosPreset::sensor);
  EXPECT_THROW(Reader<msg::Segments>(participant, topic, QosPreset::sensor), std::runtime_error);
  EXPECT_THROW(RawReader(participant, topic, "strange::Type_", QosPreset::sensor),
               std::runtime_error);
}

TEST(Raw, ATypeWithAKeyIsWrittenAndReadRawByItsKey) {
  Participant sender({test_domain(), "sender"});
  Participant receiver({test_domain(), "receiver"});
  const std::string topic = test_namespace() + "/map/line_map";
  const std::string type = "quoin::msg::LineMap";
  Writer<msg::LineMap> writer(sender, topic, QosPreset::state);
  RawWriter raw_writer(sender, topic, type, QosPreset::state);
  msg::LineMap part;
  part.parts(3);
  topics::RawMessage raw;
  for (const std::uint32_t version : {1U, 2U}) {
    for (const std::uint32_t number : {0U, 1U}) {
      part.part(number);
      part.version(version);
      ASSERT_TRUE(writer.write(part));
    }
    part.part(2);
    topics::encode(part, raw);
    ASSERT_TRUE(raw_writer.write(raw));
  }
  // They come late and get the last message of each part.
  Reader<msg::LineMap> typed_reader(receiver, topic, QosPreset::state);
  RawReader raw_reader(receiver, topic, type, QosPreset::state);
  std::set<std::uint32_t> typed_parts, raw_parts;
  msg::LineMap got;
  for (int i = 0; i < 3; ++i) {
    ASSERT_TRUE(take_within(typed_reader, got));
    EXPECT_EQ(got.version(), 2U);
    typed_parts.insert(got.part());
    ASSERT_TRUE(take_within(raw_reader, raw));
    ASSERT_TRUE(topics::decode(raw, got));
    EXPECT_EQ(got.version(), 2U);
    raw_parts.insert(got.part());
  }
  EXPECT_EQ(typed_parts, (std::set<std::uint32_t>{0, 1, 2}));
  EXPECT_EQ(raw_parts, typed_parts);
}

TEST(Raw, KeysLongerThanTheGeneratedCodeHasRoomForAreKeys) {
  Participant sender({test_domain(), "sender"});
  Participant receiver({test_domain(), "receiver"});
  const std::string topic = test_namespace() + "/status";
  Writer<msg::ServiceStatus> writer(sender, topic, QosPreset::state);
  Reader<msg::ServiceStatus> reader(receiver, topic, QosPreset::state);
  ASSERT_TRUE(writer.wait_for_readers(1, 10s));
  msg::ServiceStatus status;
  for (const char last : {'a', 'b'}) {
    status.service(std::string(1000, 'x') + last);
    ASSERT_TRUE(writer.write(status));
  }
  // It keeps one message of each instance, so both arrive only when their keys differ.
  msg::ServiceStatus got;
  std::set<char> instances;
  while (instances.size() < 2 && take_within(reader, got)) instances.insert(got.service().back());
  EXPECT_EQ(instances, (std::set{'a', 'b'}));
}

}  // namespace
}  // namespace quoin::runtime
