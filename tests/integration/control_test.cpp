// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include <idl/Control.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "services/runtime/writer.hpp"
#include "tests/integration/harness/deployment.hpp"

namespace quoin {
namespace {

using namespace std::chrono_literals;
using testing::HasSubstr;
using tests::CornerRecorder;
using tests::Process;
using tests::TestDeployment;

/// A requester with a running chain whose fitter it may change.
class Control : public testing::Test {
 protected:
  Control()
      : participant_(deployment_.participant("test")),
        recorder_(participant_, deployment_, "corners"),
        requests_(participant_, deploy::control_request_topic(deployment_.deployment().name_space),
                  runtime::QosPreset::control),
        replies_(participant_, deploy::control_reply_topic(deployment_.deployment().name_space),
                 runtime::QosPreset::control) {
    for (const auto& service : deployment_.deployment().services)
      processes_.push_back(deployment_.start(service.name));
    EXPECT_TRUE(recorder_.wait_for(5));
    EXPECT_TRUE(requests_.wait_for_readers(3, 20s));
    EXPECT_TRUE(replies_.wait_for_writers(3, 20s));
  }

  msg::ControlReply ask(msg::ControlAction action, const std::string& method,
                        const std::vector<std::pair<std::string, std::string>>& parameters) {
    msg::ControlRequest request;
    request.service("wctls");
    request.requester("test");
    request.request(++number_);
    request.action(action);
    request.method(method);
    for (const auto& [name, value] : parameters) {
      request.parameters().emplace_back();
      request.parameters().back().name(name);
      request.parameters().back().value(value);
    }
    EXPECT_TRUE(requests_.write(request));
    msg::ControlReply reply;
    EXPECT_TRUE(
        tests::eventually([&] { return replies_.take(reply) && reply.request() == number_; }));
    return reply;
  }

  TestDeployment deployment_{R"(
  - {name: front, kind: simulated, parameters: {rate_hz: 50}}
  - {name: walls, kind: segmentation, input: front, method: iepf}
  - {name: wctls, kind: line_fitting, input: walls, method: wctls}
  - {name: corners, kind: corner_estimation, input: wctls, method: adjacent}
)"};
  runtime::Participant participant_;
  CornerRecorder recorder_;
  runtime::Writer<msg::ControlRequest> requests_;
  runtime::Reader<msg::ControlReply> replies_;
  std::vector<Process> processes_;
  std::uint64_t number_ = 0;
};

TEST_F(Control, AMethodIsExchangedBetweenTwoScans) {
  const msg::ControlReply reply =
      ask(msg::ControlAction::CONTROL_SWAP_METHOD, "utls", {{"covariance", "as_published"}});
  ASSERT_TRUE(reply.accepted()) << reply.detail();
  EXPECT_EQ(reply.method(), "utls");
  ASSERT_TRUE(recorder_.wait_for(recorder_.poll() + 10));
  for (const msg::Corners& message : recorder_.messages()) {
    const bool after = message.header().sequence_number() >= reply.first_sequence_number();
    EXPECT_EQ(message.header().trace()[2].method(), after ? "utls" : "wctls");
    EXPECT_EQ(message.covariance_mode(), after ? "as_published" : "propagated");
  }
  EXPECT_EQ(recorder_.accounting().lost(), 0U);
  EXPECT_EQ(recorder_.accounting().duplicates(), 0U);
}

TEST_F(Control, ARefusedRequestChangesNothing) {
  const msg::ControlReply unknown = ask(msg::ControlAction::CONTROL_SWAP_METHOD, "wclts", {});
  EXPECT_FALSE(unknown.accepted());
  EXPECT_THAT(unknown.detail(), HasSubstr("did you mean 'wctls'?"));
  const msg::ControlReply wrong =
      ask(msg::ControlAction::CONTROL_SET_PARAMETERS, "", {{"covariance", "guessed"}});
  EXPECT_FALSE(wrong.accepted());
  const msg::ControlReply strange = ask(static_cast<msg::ControlAction>(99), "", {});
  EXPECT_FALSE(strange.accepted());
  const msg::ControlReply now = ask(msg::ControlAction::CONTROL_DESCRIBE, "", {});
  EXPECT_TRUE(now.accepted());
  EXPECT_EQ(now.method(), "wctls");
  EXPECT_TRUE(now.parameters().empty());
}

}  // namespace
}  // namespace quoin
