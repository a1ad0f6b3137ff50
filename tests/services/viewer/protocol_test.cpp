// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/viewer/protocol.hpp"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

namespace quoin::viewer {
namespace {

using nlohmann::json;
using testing::ElementsAre;

TEST(Protocol, HeadOfAMessageIsOpcodeSubscriptionAndTime) {
  const std::string head = message_head(0x04030201, 0x0102030405060708);
  EXPECT_EQ(head, std::string("\x01\x01\x02\x03\x04\x08\x07\x06\x05\x04\x03\x02\x01", 13));
}

TEST(Protocol, ResponseOfAServiceNamesItsCall) {
  EXPECT_EQ(service_response(1, 2, "{}"),
            std::string("\x03\x01\0\0\0\x02\0\0\0\x04\0\0\0json{}", 19));
}

TEST(Protocol, ChannelsAreAdvertisedWithTheirSchemas) {
  const std::vector<Channel> channels{
      {3, "robot/front/scan", "cdr", "quoin::msg::Scan", "omgidl", "x\ny"}};
  const json message = json::parse(advertisement(channels));
  EXPECT_EQ(message["op"], "advertise");
  EXPECT_EQ(message["channels"][0]["id"], 3);
  EXPECT_EQ(message["channels"][0]["schemaName"], "quoin::msg::Scan");
  EXPECT_EQ(message["channels"][0]["schema"], "x\ny");
}

TEST(Protocol, TextThatIsNoUtf8IsStillJson) {
  EXPECT_TRUE(json::accept(status(StatusLevel::warning, "\xff\xfe")));
}

TEST(Protocol, ReadsSubscriptions) {
  const Request request = parse_text(
      R"({"op":"subscribe","subscriptions":[{"id":7,"channelId":1},{"id":8,"channelId":2}]})");
  const auto& subscribe = std::get<Subscribe>(request);
  ASSERT_EQ(subscribe.subscriptions.size(), 2U);
  EXPECT_EQ(subscribe.subscriptions[1].id, 8U);
  EXPECT_EQ(subscribe.subscriptions[1].channel, 2U);
  EXPECT_THAT(std::get<Unsubscribe>(parse_text(R"({"op":"unsubscribe","subscriptionIds":[7,8]})"))
                  .subscriptions,
              ElementsAre(7U, 8U));
}

TEST(Protocol, OperationsThatAreNotOfferedAreNoErrors) {
  EXPECT_EQ(std::get<NotOffered>(parse_text(R"({"op":"getParameters"})")).operation,
            "getParameters");
  EXPECT_EQ(std::get<NotOffered>(parse_binary("\x01\x02")).operation, "binary 1");
}

TEST(Protocol, ReadsServiceCalls) {
  const auto call = std::get<ServiceCall>(
      parse_binary(std::string("\x02\x05\0\0\0\x09\0\0\0\x04\0\0\0json{\"x\":1}", 24)));
  EXPECT_EQ(call.service, 5U);
  EXPECT_EQ(call.call, 9U);
  EXPECT_EQ(call.encoding, "json");
  EXPECT_EQ(call.request, "{\"x\":1}");
}

class Garbage : public testing::TestWithParam<const char*> {};

TEST_P(Garbage, IsAnError) { EXPECT_THROW((void)parse_text(GetParam()), ProtocolError); }

INSTANTIATE_TEST_SUITE_P(
    Texts, Garbage,
    testing::Values("", "{", "[]", "7", "{}", R"({"op":7})", R"({"op":"subscribe"})",
                    R"({"op":"subscribe","subscriptions":{}})",
                    R"({"op":"subscribe","subscriptions":[7]})",
                    R"({"op":"subscribe","subscriptions":[{"id":1}]})",
                    R"({"op":"subscribe","subscriptions":[{"id":-1,"channelId":1}]})",
                    R"({"op":"subscribe","subscriptions":[{"id":1,"channelId":4294967296}]})",
                    R"({"op":"subscribe","subscriptions":[{"id":1.5,"channelId":1}]})",
                    R"({"op":"unsubscribe","subscriptionIds":["1"]})"));

TEST(Protocol, CallsThatAreCutShortAreErrors) {
  EXPECT_THROW((void)parse_binary(""), ProtocolError);
  EXPECT_THROW((void)parse_binary(std::string("\x02\x01\0\0", 4)), ProtocolError);
  EXPECT_THROW((void)parse_binary(std::string("\x02\x01\0\0\0\x01\0\0\0\xff\xff\xff\xffjson", 17)),
               ProtocolError);
}

}  // namespace
}  // namespace quoin::viewer
