// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include <ctime>
#include <idl/Control.h>
#include <idl/Scan.h>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "services/runtime/dds/endpoints.hpp"
#include "services/topics/header.hpp"
#include "tests/integration/harness/deployment.hpp"

namespace quoin {
namespace {

using namespace std::chrono_literals;
using testing::HasSubstr;
using tests::CornerRecorder;
using tests::Process;
using tests::TestDeployment;

/// With the default, a machine that is busy elsewhere for a tenth of a second costs a scan.
constexpr const char* lossless = "qos: lossless\n";

/// A requester with a running chain whose fitter it may change.
class Control : public testing::Test {
 protected:
  explicit Control(int rate = 50, const std::string& head = lossless)
      : deployment_("  - {name: front, kind: simulated, parameters: {rate_hz: " +
                        std::to_string(rate) + R"(}}
  - {name: walls, kind: segmentation, input: front, method: iepf}
  - {name: wctls, kind: line_fitting, input: walls, method: wctls}
  - {name: corners, kind: corner_estimation, input: wctls, method: adjacent}
)",
                    head),
        participant_(deployment_.participant("test")),
        recorder_(participant_, deployment_, "corners"),
        requests_(participant_, control_request_topic(deployment_.deployment().name_space),
                  runtime::QosPreset::control),
        replies_(participant_, control_reply_topic(deployment_.deployment().name_space),
                 runtime::QosPreset::control) {
    for (const auto& service : deployment_.deployment().services)
      processes_.push_back(deployment_.start(service.name));
    EXPECT_TRUE(recorder_.wait_for(5));
    EXPECT_TRUE(requests_.wait_for_readers(4, 20s));
    EXPECT_TRUE(replies_.wait_for_writers(4, 20s));
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
        recorder_.poll_until([&] { return replies_.take(reply) && reply.request() == number_; }));
    return reply;
  }

  TestDeployment deployment_;
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
    const bool after = topics::sequence_number(message.header()) >= reply.first_sequence_number();
    EXPECT_EQ(message.header().trace()[2].method(), after ? "utls" : "wctls");
    EXPECT_EQ(message.covariance_mode(), after ? "as_published" : "propagated");
  }
  EXPECT_THAT(recorder_.accounting().lost_by_site(), testing::IsEmpty());
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

TEST_F(Control, TheCommandLineSwapsAndSetsAndTellsTheFirstScan) {
  const auto command = [this](std::vector<std::string> arguments, int exit_code) {
    arguments.insert(arguments.end(), {"--deployment", "FILE", "--json"});
    Process process = deployment_.quoin(std::move(arguments));
    EXPECT_TRUE(recorder_.poll_until([&] { return process.wait(0ms).has_value(); }));
    EXPECT_EQ(process.wait(0ms), exit_code) << process.errors();
    return nlohmann::json::parse(process.output());
  };
  const nlohmann::json swapped = command({"swap", "wctls", "utls"}, 0);
  EXPECT_EQ(swapped["method"], "utls");
  const nlohmann::json set = command({"set", "wctls", "covariance=as_published"}, 0);
  EXPECT_EQ(set["method"], "utls");
  EXPECT_EQ(set["parameters"]["covariance"], "as_published");
  const nlohmann::json refused = command({"swap", "wctls", "wclts"}, 2);
  EXPECT_EQ(refused["accepted"], false);
  EXPECT_THAT(refused["detail"].get<std::string>(), HasSubstr("did you mean 'wctls'?"));
  ASSERT_TRUE(recorder_.wait_for(recorder_.poll() + 10));
  const auto first_swapped = swapped["first_sequence_number"].get<std::uint64_t>();
  const auto first_set = set["first_sequence_number"].get<std::uint64_t>();
  EXPECT_LT(first_swapped, first_set);
  for (const msg::Corners& message : recorder_.messages()) {
    const std::uint64_t number = topics::sequence_number(message.header());
    EXPECT_EQ(message.header().trace()[2].method(), number >= first_swapped ? "utls" : "wctls");
    EXPECT_EQ(message.covariance_mode(), number >= first_set ? "as_published" : "propagated");
  }
  EXPECT_THAT(recorder_.accounting().lost_by_site(), testing::IsEmpty());
}

TEST_F(Control, AServiceThatIsNotThereIsNamed) {
  Process process = deployment_.quoin({"swap", "walls_2", "hough", "--deployment", "FILE"});
  EXPECT_EQ(process.wait(20s), 2);
  EXPECT_THAT(process.errors(), HasSubstr("walls_2"));
  Process source = deployment_.quoin({"swap", "front", "hough", "--deployment", "FILE"});
  EXPECT_EQ(source.wait(20s), 2);
  EXPECT_THAT(source.errors(), HasSubstr("kind simulated has no methods"));
}

struct Load {
  int rate;  // [Hz]
  const char* head;
};

class HundredSwaps : public Control, public testing::WithParamInterface<Load> {
 protected:
  HundredSwaps()
      : Control(GetParam().rate, GetParam().head),
        scans_(participant_, deployment_.topic("front"), runtime::QosPreset::sensor) {}

  /// Number of the newest scan that has been published.
  std::uint64_t newest_scan() {
    EXPECT_TRUE(tests::eventually([this] {
      while (scans_.take(scan_)) seen_ = true;
      return seen_;
    }));
    return topics::sequence_number(scan_.header());
  }

  runtime::Reader<msg::Scan> scans_;
  msg::Scan scan_;
  bool seen_ = false;
};

// Each method is built while scans go on; none of them may cost one.
TEST_P(HundredSwaps, LoseNoScanAndAreInForceAtOnce) {
  std::vector<std::pair<std::uint64_t, std::string>> firsts;
  int at_once = 0;
  for (int k = 0; k < 100; ++k) {
    const std::string method = k % 2 == 0 ? "inverse_range" : "utls";
    const std::uint64_t newest = newest_scan();
    const msg::ControlReply reply = ask(msg::ControlAction::CONTROL_SWAP_METHOD, method, {});
    ASSERT_TRUE(reply.accepted()) << reply.detail();
    firsts.emplace_back(reply.first_sequence_number(), method);
    at_once += reply.first_sequence_number() <= newest + 2 ? 1 : 0;
  }
  // Within two scans of the request. At 200 Hz a busy machine may let it travel for longer at
  // times.
  EXPECT_GE(at_once, GetParam().rate > 100 ? 50 : 100);
  const std::uint64_t last = firsts.back().first;
  ASSERT_TRUE(recorder_.poll_until(
      [&] { return topics::sequence_number(recorder_.messages().back().header()) > last; }));
  auto next = firsts.begin();
  std::string expected = "wctls";
  std::uint64_t number = topics::sequence_number(recorder_.messages().front().header());
  for (const msg::Corners& message : recorder_.messages()) {
    ASSERT_EQ(topics::sequence_number(message.header()), number) << "lost, doubled or out of order";
    while (next != firsts.end() && number >= next->first) expected = next++->second;
    EXPECT_EQ(message.header().trace()[2].method(), expected) << number;
    ++number;
  }
  EXPECT_THAT(recorder_.accounting().lost_by_site(), testing::IsEmpty());
  EXPECT_EQ(recorder_.accounting().duplicates(), 0U);
}

// As fast as a script that runs wild: unknown methods, oversized values, a service that is none.
TEST_F(Control, AFloodOfBadRequestsIsAnsweredOrCountedAndCostsNoScan) {
  tests::StatusRecorder statuses(participant_, deployment_);
  constexpr std::uint64_t first = 1000;
  constexpr std::uint64_t count = 3000;
  std::size_t replies = 0;
  std::set<std::string> reasons;
  msg::ControlReply reply;
  const auto take_replies = [&] {
    recorder_.poll();
    while (replies_.take(reply)) {
      if (reply.request() < first) continue;
      EXPECT_FALSE(reply.accepted());
      EXPECT_EQ(reply.service(), "wctls");
      reasons.insert(reply.detail());
      ++replies;
    }
  };
  msg::ControlRequest request;
  request.requester("test");
  request.action(msg::ControlAction::CONTROL_SWAP_METHOD);
  for (std::uint64_t k = 0; k < count; ++k) {
    request.service(k % 3 == 0 ? "nobody" : "wctls");
    request.method(k % 3 == 1 ? "wclts" : std::string(10'000, 'x'));
    request.request(first + k);
    EXPECT_TRUE(requests_.write(request));
    take_replies();
    const timespec millisecond{0, 1'000'000};  // the rate of the flood
    ::nanosleep(&millisecond, nullptr);
  }
  EXPECT_TRUE(statuses.wait_for("wctls",
                                [&](const msg::ServiceStatus& status) {
                                  take_replies();
                                  return status.control_dropped() > 0 &&
                                         replies + status.control_dropped() >= count / 3;
                                }))
      << replies << " replies, " << statuses.latest("wctls").control_dropped() << " dropped";
  EXPECT_LE(replies + statuses.latest("wctls").control_dropped(), count / 3 * 2);
  EXPECT_THAT(reasons, testing::Contains(HasSubstr("did you mean 'wctls'?")));
  EXPECT_THAT(reasons, testing::Contains(HasSubstr("larger than any request")));
  const msg::ControlReply now = ask(msg::ControlAction::CONTROL_DESCRIBE, "", {});
  EXPECT_TRUE(now.accepted());
  EXPECT_EQ(now.method(), "wctls");
  EXPECT_THAT(recorder_.accounting().lost_by_site(), testing::IsEmpty());
  EXPECT_EQ(recorder_.accounting().duplicates(), 0U);
}
INSTANTIATE_TEST_SUITE_P(Rates, HundredSwaps, testing::Values(Load{10, ""}, Load{200, lossless}),
                         [](const auto& load) { return std::to_string(load.param.rate) + "Hz"; });

}  // namespace
}  // namespace quoin
