// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/topics/protobuf/message_encoder.hpp"

#include <cmath>
#include <google/protobuf/descriptor.pb.h>
#include <google/protobuf/dynamic_message.h>
#include <idl/Lines.h>
#include <idl/Scan.h>
#include <limits>
#include <memory>
#include <string>

#include <gtest/gtest.h>

#include "services/topics/cdr_codec.hpp"
#include "services/topics/protobuf/schemas.hpp"
#include "services/topics/topic_types.hpp"

namespace quoin::topics {
namespace {

namespace pb = google::protobuf;

/// Messages of a type that is known by its description alone, as a viewer knows it: from the schema
/// of a recording.
class Described {
 public:
  explicit Described(std::string_view name) {
    pb::FileDescriptorSet set;
    EXPECT_TRUE(set.ParseFromString(protobuf_descriptor_set(name)));
    for (const pb::FileDescriptorProto& file : set.file()) {
      EXPECT_NE(pool_.BuildFile(file), nullptr) << file.name();
    }
    prototype_ = factory_.GetPrototype(pool_.FindMessageTypeByName(std::string(name)));
  }
  [[nodiscard]] std::unique_ptr<pb::Message> parse(const std::string& bytes) const {
    std::unique_ptr<pb::Message> message(prototype_->New());
    EXPECT_TRUE(message->ParseFromString(bytes));
    return message;
  }

 private:
  pb::DescriptorPool pool_;
  pb::DynamicMessageFactory factory_;
  const pb::Message* prototype_ = nullptr;
};

template <class T>
std::string encoded(const T& message) {
  RawMessage raw;
  encode(message, raw);
  std::string bytes;
  MessageEncoder(type_name<T>()).encode(raw.cdr, bytes);
  return bytes;
}

const pb::FieldDescriptor* field(const pb::Message& message, const char* name) {
  return message.GetDescriptor()->FindFieldByName(name);
}

double number(const pb::Message& message, const char* name) {
  return message.GetReflection()->GetDouble(message, field(message, name));
}

TEST(MessageEncoder, KnowsEveryTopicType) {
  for (const TopicType& type : topic_types()) EXPECT_NO_THROW(MessageEncoder{type.dds_type});
  EXPECT_THROW(MessageEncoder("quoin::msg::Nothing"), std::out_of_range);
}

TEST(MessageEncoder, WritesWhatProtobufWrites) {
  msg::Lines lines;
  lines.header().stamp(-5);
  lines.header().frame("laser");
  lines.header().origins().resize(2);
  lines.header().origins()[1].sequence_number(std::numeric_limits<std::uint64_t>::max());
  lines.sensor_model().range_stddev(-0.0);
  lines.covariance_mode("propagated");
  lines.lines().resize(3);
  lines.lines()[1].alpha(0.25);
  lines.lines()[1].gaussian(true);
  lines.lines()[1].points(300);
  lines.failures().resize(1);
  lines.failures()[0].reason(std::string(200, 'x'));

  const std::string bytes = encoded(lines);
  const Described described("quoin.msg.Lines");
  const auto message = described.parse(bytes);

  // Protobuf's own serialisation of what it has read is the same, byte for byte.
  EXPECT_EQ(message->SerializeAsString(), bytes);
  const pb::Reflection& reflection = *message->GetReflection();
  ASSERT_EQ(reflection.FieldSize(*message, field(*message, "lines")), 3);
  const pb::Message& second = reflection.GetRepeatedMessage(*message, field(*message, "lines"), 1);
  EXPECT_EQ(number(second, "alpha"), 0.25);
  EXPECT_TRUE(second.GetReflection()->GetBool(second, field(second, "gaussian")));
  const pb::Message& header = reflection.GetMessage(*message, field(*message, "header"));
  EXPECT_EQ(header.GetReflection()->GetInt64(header, field(header, "stamp")), -5);
}

TEST(MessageEncoder, KeepsRangesBitForBit) {
  msg::Scan scan;
  scan.bearings({-1.0F, 0.0F, 1.0F});
  scan.ranges(
      {std::numeric_limits<float>::infinity(), std::numeric_limits<float>::quiet_NaN(), 0.1F});

  const Described described("quoin.msg.Scan");
  const auto message = described.parse(encoded(scan));

  const auto ranges =
      message->GetReflection()->GetRepeatedFieldRef<float>(*message, field(*message, "ranges"));
  ASSERT_EQ(ranges.size(), 3);
  EXPECT_EQ(ranges.Get(0), std::numeric_limits<float>::infinity());
  EXPECT_TRUE(std::isnan(ranges.Get(1)));
  EXPECT_EQ(ranges.Get(2), 0.1F);
}

TEST(MessageEncoder, ReadsTheOtherByteOrder) {
  // A failure of segment 0x0102 and the reason "no", big-endian.
  const unsigned char big[] = {0, 0, 0, 0, 0, 0, 1, 2, 0, 0, 0, 3, 'n', 'o', 0, 0};
  std::string bytes;
  MessageEncoder("quoin::msg::Failure").encode(std::as_bytes(std::span(big)), bytes);
  EXPECT_EQ(bytes, std::string("\x08\x82\x02\x12\x02no"));
}

TEST(MessageEncoder, RefusesWhatIsCutOff) {
  RawMessage raw;
  msg::Scan scan;
  scan.ranges(std::vector<float>(10, 1.0F));
  encode(scan, raw);
  const MessageEncoder encoder("quoin::msg::Scan");
  std::string bytes;
  EXPECT_THROW(encoder.encode(std::span(raw.cdr).first(raw.cdr.size() - 8), bytes), CdrError);
  EXPECT_THROW(encoder.encode({}, bytes), CdrError);
}

}  // namespace
}  // namespace quoin::topics
