// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/runtime/node/method_exchange.hpp"

#include <atomic>
#include <future>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/services/runtime/node/stage.hpp"

namespace quoin::runtime {
namespace {

using std::chrono::milliseconds;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

State state_of(int number) {
  const std::string text = std::to_string(number);
  return {text.begin(), text.end()};
}

int number_in(const State& state) { return std::stoi(std::string(state.begin(), state.end())); }

/// What the methods of these tests have done and know: `count` and `sum` keep a number in the form
/// "number/1", `map` keeps another form, `plain` keeps nothing.
class Methods {
 public:
  MethodFactory factory() {
    return [this](const std::string& name, const ParameterSettings& parameters) {
      for (const ParameterSetting& setting : parameters) {
        if (setting.name != "gain" && setting.name != "limit") {
          throw ParameterError(setting.name, "is not known");
        }
      }
      return make(name);
    };
  }

  std::vector<std::string> handled;  ///< by which method
  int refused_state = -1;

 private:
  Method make(const std::string& name) {
    const auto note = [this, name](Work&) { handled.push_back(name); };
    if (name == "plain") return {.handle = note};
    if (name != "count" && name != "sum" && name != "map") {
      throw ParameterError("method", "unknown method '" + name + "'");
    }
    const auto number = std::make_shared<int>(0);
    return {.handle =
                [note, number](Work& work) {
                  ++*number;
                  note(work);
                },
            .state_form = name == "map" ? "map/1" : "number/1",
            .save = [number] { return state_of(*number); },
            .restore =
                [this, number](const State& state) {
                  const int restored = number_in(state);
                  if (restored == refused_state) throw std::invalid_argument("not that one");
                  *number = restored;
                }};
  }
};

msg::ControlRequest swap(const std::string& method, bool drop_state = false) {
  msg::ControlRequest request;
  request.action(msg::ControlAction::CONTROL_SWAP_METHOD);
  request.method(method);
  request.drop_state(drop_state);
  return request;
}

msg::ControlRequest with(msg::ControlRequest request, const std::string& name,
                         const std::string& value) {
  msg::ParameterSetting& setting = request.parameters().emplace_back();
  setting.name(name);
  setting.value(value);
  return request;
}

msg::ControlRequest set(const std::string& name, const std::string& value) {
  msg::ControlRequest request;
  request.action(msg::ControlAction::CONTROL_SET_PARAMETERS);
  return with(request, name, value);
}

std::vector<std::string> settings(const msg::ControlReply& reply) {
  std::vector<std::string> texts;
  for (const msg::ParameterSetting& setting : reply.parameters()) {
    texts.push_back(setting.name() + "=" + setting.value());
  }
  return texts;
}

/// A node whose method is exchanged while messages come.
class ExchangeTest : public testing::Test {
 protected:
  void make(const std::string& method, ParameterSettings parameters = {}) {
    stage_.emplace(
        Node::Settings{.service = "walls", .method = method, .parameters = std::move(parameters)},
        methods_.factory(), outputs(output_part(results_)));
    stage_->node().open(inputs(input_part({"scan", "scan"}, "front", queue_)));
  }
  void publish(int count = 1) {
    for (int i = 0; i < count; ++i) queue_->push(front_.next());
    stage_->run();
  }
  MethodExchange& exchange() { return stage_->node().exchange(); }

  /// Asks in a thread of its own, as the control thread does, and lets messages come until the
  /// answer is there.
  msg::ControlReply ask(const msg::ControlRequest& request) {
    auto answer = std::async(std::launch::async, [&] {
      msg::ControlReply reply;
      exchange().handle(request, reply);
      return reply;
    });
    while (answer.wait_for(milliseconds(0)) != std::future_status::ready) publish();
    return answer.get();
  }
  std::string refusal(const msg::ControlRequest& request) {
    try {
      (void)ask(request);
    } catch (const std::exception& error) {
      return error.what();
    }
    return "";
  }
  msg::ControlReply describe() {
    msg::ControlRequest request;
    request.action(msg::ControlAction::CONTROL_DESCRIBE);
    msg::ControlReply reply;
    exchange().handle(request, reply);
    return reply;
  }
  int state() { return number_in(exchange().save()); }

  Methods methods_;
  Numbered<msg::Scan> front_{"front"};
  std::shared_ptr<MemoryQueue<msg::Scan>> queue_ = std::make_shared<MemoryQueue<msg::Scan>>();
  std::shared_ptr<MemoryTopic<msg::Segments>> results_ =
      std::make_shared<MemoryTopic<msg::Segments>>();
  std::optional<Stage> stage_;
};

TEST_F(ExchangeTest, HappensBetweenTwoMessages) {
  make("plain");
  publish(3);
  const msg::ControlReply reply = ask(swap("count"));
  publish(2);
  EXPECT_TRUE(reply.accepted());
  EXPECT_EQ(reply.method(), "count");
  const std::uint64_t first = reply.first_sequence_number();
  ASSERT_GE(first, 3U);
  for (std::uint64_t i = 0; i < results_->written.size(); ++i) {
    EXPECT_EQ(results_->written[i].header().trace().back().method(), i < first ? "plain" : "count");
    EXPECT_EQ(methods_.handled[i], i < first ? "plain" : "count");
    EXPECT_EQ(indices(results_->written)[i], i) << "none lost, none doubled";
  }
  EXPECT_EQ(stage_->status().method(), "count");
}

TEST_F(ExchangeTest, AnUnknownMethodChangesNothing) {
  make("count", {{"gain", "2"}});
  publish(3);
  EXPECT_THAT(refusal(swap("cuont")), HasSubstr("cuont"));
  EXPECT_EQ(describe().method(), "count");
  EXPECT_THAT(settings(describe()), ElementsAre("gain=2"));
  publish();
  EXPECT_EQ(methods_.handled.back(), "count");
  EXPECT_EQ(state(), static_cast<int>(results_->written.size()));
}

TEST_F(ExchangeTest, ABadParameterChangesNothing) {
  make("count", {{"gain", "2"}});
  EXPECT_NE(refusal(set("gian", "3")), "");
  EXPECT_NE(refusal(with(swap("sum"), "gian", "3")), "");
  EXPECT_EQ(describe().method(), "count");
  EXPECT_THAT(settings(describe()), ElementsAre("gain=2"));
}

TEST_F(ExchangeTest, AnUnknownActionIsRefused) {
  make("count");
  msg::ControlRequest request;
  request.action(msg::ControlAction::CONTROL_APPLY);
  EXPECT_NE(refusal(request), "");
}

TEST_F(ExchangeTest, ParametersThatAreSetJoinThoseInForce) {
  make("count", {{"gain", "2"}});
  EXPECT_THAT(settings(ask(set("limit", "7"))), ElementsAre("gain=2", "limit=7"));
  EXPECT_THAT(settings(ask(set("gain", "3"))), ElementsAre("gain=3", "limit=7"));
  EXPECT_EQ(describe().method(), "count");
}

TEST_F(ExchangeTest, AnotherMethodBeginsWithItsDefaults) {
  make("count", {{"gain", "2"}});
  EXPECT_THAT(settings(ask(with(swap("sum"), "limit", "1"))), ElementsAre("limit=1"));
}

TEST_F(ExchangeTest, TheStateGoesOverToTheSameForm) {
  make("count");
  publish(5);
  const msg::ControlReply reply = ask(swap("sum"));
  EXPECT_EQ(reply.method(), "sum");
  EXPECT_EQ(state(), static_cast<int>(results_->written.size())) << "it went on counting";
  (void)ask(set("gain", "2"));
  EXPECT_EQ(state(), static_cast<int>(results_->written.size()));
}

TEST_F(ExchangeTest, AnotherFormIsRefusedUnlessTheStateIsDropped) {
  make("count");
  publish(5);
  EXPECT_THAT(refusal(swap("map")), HasSubstr("number/1"));
  EXPECT_THAT(refusal(swap("plain")), HasSubstr("number/1"));
  EXPECT_EQ(describe().method(), "count");
  EXPECT_EQ(state(), static_cast<int>(results_->written.size()));
  const msg::ControlReply reply = ask(swap("map", true));
  EXPECT_EQ(reply.method(), "map");
  EXPECT_EQ(state(), static_cast<int>(results_->written.size() - reply.first_sequence_number()))
      << "it began anew";
}

TEST_F(ExchangeTest, AMethodThatKeptNothingGivesWayToAny) {
  make("plain");
  publish();
  EXPECT_EQ(ask(swap("map")).method(), "map");
}

TEST_F(ExchangeTest, AStateThatCannotBeTakenLeavesTheOldOneInForce) {
  make("count");
  publish(5);
  methods_.refused_state = 5;
  msg::ControlReply reply;
  // No message comes between the request and its application, so the state is 5 still.
  auto answer = std::async(std::launch::async, [&] { exchange().handle(swap("sum"), reply); });
  while (answer.wait_for(milliseconds(0)) != std::future_status::ready) {
    EXPECT_FALSE(exchange().apply(5));
  }
  EXPECT_THROW(answer.get(), std::runtime_error);
  EXPECT_EQ(describe().method(), "count");
  publish();
  EXPECT_EQ(methods_.handled.back(), "count");
  EXPECT_EQ(state(), 6);
  EXPECT_EQ(ask(swap("sum")).method(), "sum") << "the next request is not held against it";
}

class PendingExchange : public testing::Test {
 protected:
  msg::ControlReply ask(const msg::ControlRequest& request) {
    msg::ControlReply reply;
    exchange_.handle(request, reply);
    return reply;
  }
  msg::ControlReply describe() {
    msg::ControlRequest request;
    request.action(msg::ControlAction::CONTROL_DESCRIBE);
    return ask(request);
  }

  Methods methods_;
  MethodExchange exchange_{"count", {{"gain", "2"}}, methods_.factory(), milliseconds(0)};
};

TEST_F(PendingExchange, IsAppliedAtTheNextMessage) {
  const msg::ControlReply reply = ask(swap("sum"));
  EXPECT_TRUE(reply.accepted());
  EXPECT_EQ(reply.method(), "sum");
  EXPECT_NE(reply.detail(), "");
  EXPECT_EQ(exchange_.name(), "count");
  EXPECT_TRUE(exchange_.apply(0));
  EXPECT_EQ(exchange_.name(), "sum");
  EXPECT_FALSE(exchange_.apply(1)) << "once";
}

TEST_F(PendingExchange, GivesWayToAnotherRequest) {
  (void)ask(swap("sum"));
  (void)ask(set("limit", "3"));
  EXPECT_EQ(describe().method(), "sum") << "parameters of what is wanted";
  EXPECT_THAT(settings(describe()), ElementsAre("limit=3"));
  EXPECT_TRUE(exchange_.apply(0));
  EXPECT_EQ(exchange_.name(), "sum");
}

TEST_F(PendingExchange, ThatIsRefusedWhenItIsAppliedIsNotDescribedAsInForce) {
  methods_.refused_state = 0;
  (void)ask(with(swap("sum"), "limit", "3"));
  EXPECT_FALSE(exchange_.apply(0));
  EXPECT_EQ(exchange_.name(), "count");
  EXPECT_EQ(describe().method(), "count");
  EXPECT_THAT(settings(describe()), ElementsAre("gain=2"));
}

TEST(MethodState, OfAPredecessorIsGoneOnWith) {
  Methods methods;
  MethodExchange exchange("count", {}, methods.factory());
  exchange.restore(state_of(7));
  EXPECT_EQ(exchange.save(), state_of(7));
  exchange.restore({});
  EXPECT_EQ(exchange.save(), state_of(7)) << "nothing was given";
  EXPECT_THROW(exchange.restore({'x'}), std::invalid_argument);
  EXPECT_EQ(exchange.save(), state_of(7));
  MethodExchange plain("plain", {}, methods.factory());
  EXPECT_THAT(plain.save(), IsEmpty());
  EXPECT_THROW(plain.restore(state_of(7)), std::invalid_argument);
}

}  // namespace
}  // namespace quoin::runtime
