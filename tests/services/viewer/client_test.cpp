// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/viewer/client.hpp"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "services/viewer/hub.hpp"

namespace quoin::viewer {
namespace {

using nlohmann::json;
using testing::HasSubstr;

Payload payload(std::size_t size, char fill = 'x') {
  const auto owner = std::make_shared<const std::string>(size, fill);
  return {owner, std::as_bytes(std::span(*owner)), 5};
}

char first_byte(const Frame& frame) { return static_cast<char>(frame.payload.bytes.front()); }

/// A hub with two channels and one client that has subscribed to both.
class ClientTest : public testing::Test {
 protected:
  explicit ClientTest(std::size_t queued_bytes = 1000) {
    hub.add_channel({0, "front/scan", "cdr", "", "", ""});
    hub.add_channel({0, "walls/segments", "cdr", "", "", ""});
    hub.limit(2, {.queued_bytes = queued_bytes, .subscriptions = 10, .control_frames = 20});
    client = hub.connect([this] { ++woken; });
    while (client->next()) {
    }
  }
  void subscribe() {
    hub.receive_text(
        *client,
        R"({"op":"subscribe","subscriptions":[{"id":11,"channelId":1},{"id":12,"channelId":2}]})");
  }

  Hub hub{"robot"};
  std::shared_ptr<Client> client;
  int woken = 0;
};

TEST_F(ClientTest, IsGreetedWithServerAndChannels) {
  const auto second = hub.connect([] {});
  const json info = json::parse(second->next()->head);
  EXPECT_EQ(info["op"], "serverInfo");
  EXPECT_EQ(info["name"], "robot");
  EXPECT_EQ(json::parse(second->next()->head)["channels"].size(), 2U);
  EXPECT_FALSE(second->next());
}

TEST_F(ClientTest, NoMoreThanTheLimitAreConnected) {
  const auto second = hub.connect([] {});
  EXPECT_NE(second, nullptr);
  EXPECT_EQ(hub.connect([] {}), nullptr);
  hub.disconnect(*second);
  EXPECT_NE(hub.connect([] {}), nullptr);
}

TEST_F(ClientTest, GetsNothingThatItHasNotSubscribedTo) {
  hub.publish(1, payload(10));
  EXPECT_FALSE(client->next());
  EXPECT_EQ(woken, 0);
}

TEST_F(ClientTest, MessagesCarryItsOwnSubscription) {
  subscribe();
  hub.publish(2, payload(10));
  const auto frame = client->next();
  ASSERT_TRUE(frame);
  EXPECT_FALSE(frame->text);
  EXPECT_EQ(frame->head, message_head(12, 5));
  EXPECT_EQ(frame->payload.bytes.size(), 10U);
}

TEST_F(ClientTest, SeesTheNewestOfWhatCameBefore) {
  hub.publish(1, payload(10, 'a'));
  hub.publish(1, payload(10, 'b'));
  hub.publish(2, payload(10, 'c'), 1);
  hub.publish(2, payload(10, 'd'), 2);
  subscribe();
  EXPECT_EQ(first_byte(*client->next()), 'b');
  EXPECT_EQ(first_byte(*client->next()), 'c');
  EXPECT_EQ(first_byte(*client->next()), 'd');
  EXPECT_FALSE(client->next());
}

TEST_F(ClientTest, HearsOfChannelsThatComeLater) {
  const std::uint32_t id = hub.add_channel({0, "late", "cdr", "", "", ""});
  EXPECT_EQ(woken, 1);
  EXPECT_EQ(json::parse(client->next()->head)["channels"][0]["id"], id);
  hub.receive_text(*client, R"({"op":"subscribe","subscriptions":[{"id":1,"channelId":3}]})");
  hub.publish(id, payload(1));
  EXPECT_TRUE(client->next());
}

TEST_F(ClientTest, UnsubscribedChannelsEnd) {
  subscribe();
  hub.receive_text(*client, R"({"op":"unsubscribe","subscriptionIds":[11]})");
  hub.publish(1, payload(10));
  EXPECT_FALSE(client->next());
  EXPECT_FALSE(hub.wanted(1));
  EXPECT_TRUE(hub.wanted(2));
}

TEST_F(ClientTest, WhatItMayNotSubscribeToIsSaid) {
  hub.receive_text(*client, R"({"op":"subscribe","subscriptions":[{"id":1,"channelId":99}]})");
  const json answer = json::parse(client->next()->head);
  EXPECT_EQ(answer["op"], "status");
  EXPECT_THAT(answer["message"].get<std::string>(), HasSubstr("no channel 99"));
}

TEST_F(ClientTest, SlowOneLosesTheOldestOfTheSameChannelAndHearsOfIt) {
  subscribe();
  hub.publish(2, payload(300, 's'));
  for (const char fill : {'a', 'b', 'c', 'd'}) hub.publish(1, payload(300, fill));
  EXPECT_LE(client->queued_bytes(), 1000U);
  EXPECT_EQ(client->dropped(), 2U);
  EXPECT_EQ(hub.figures().dropped, 2U);
  const json answer = json::parse(client->next()->head);
  EXPECT_EQ(answer["op"], "status");
  EXPECT_EQ(answer["level"], 1);
  EXPECT_THAT(answer["message"].get<std::string>(), HasSubstr("2 of front/scan"));
  EXPECT_EQ(first_byte(*client->next()), 's');
  EXPECT_EQ(first_byte(*client->next()), 'c');
  EXPECT_EQ(first_byte(*client->next()), 'd');
  EXPECT_FALSE(client->next());
}

TEST_F(ClientTest, WhatIsLargerThanTheQueueIsDropped) {
  subscribe();
  hub.publish(1, payload(2000));
  EXPECT_EQ(client->queued_bytes(), 0U);
  EXPECT_THAT(json::parse(client->next()->head)["message"].get<std::string>(),
              HasSubstr("1 of front/scan"));
}

TEST_F(ClientTest, AnswersThatAreNotReadAreAFlood) {
  for (int i = 0; i < 30; ++i) hub.receive_text(*client, R"({"op":"getParameters"})");
  EXPECT_TRUE(client->flooded());
}

TEST_F(ClientTest, ManyWrongSubscriptionsInOneFrameAreNotAllAnswered) {
  json frame{{"op", "subscribe"}, {"subscriptions", json::array()}};
  for (int i = 0; i < 2000; ++i) frame["subscriptions"].push_back({{"id", i}, {"channelId", 99}});
  hub.receive_text(*client, frame.dump());
  int answers = 0;
  while (client->next()) ++answers;
  EXPECT_LT(answers, 30);
}

TEST(ClientServices, AreAnsweredOrRefused) {
  Hub hub("robot");
  hub.add_service("explain", [](const std::string& request) {
    if (request == "{}") throw std::invalid_argument("where?");
    return "{\"echo\":" + request + "}";
  });
  const auto client = hub.connect([] {});
  while (client->next()) {
  }
  const auto call = [&](std::string_view body, char service = 1) {
    std::string bytes("\x02", 1);
    bytes += std::string{service, 0, 0, 0, 7, 0, 0, 0, 4, 0, 0, 0};
    bytes += "json" + std::string(body);
    hub.receive_binary(*client, bytes);
    return *client->next();
  };
  EXPECT_EQ(call("[1]").head, service_response(1, 7, "{\"echo\":[1]}"));
  EXPECT_EQ(json::parse(call("{}").head)["message"], "where?");
  EXPECT_EQ(json::parse(call("{}", 2).head)["op"], "serviceCallFailure");
}

}  // namespace
}  // namespace quoin::viewer
