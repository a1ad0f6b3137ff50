// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include <csignal>
#include <idl/Control.h>
#include <idl/Scan.h>
#include <memory>
#include <optional>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "deploy/keys/key_directory.hpp"
#include "deploy/keys/key_files.hpp"
#include "services/runtime/writer.hpp"
#include "tests/integration/harness/deployment.hpp"

namespace quoin {
namespace {

using namespace std::chrono_literals;
using testing::HasSubstr;
using tests::CornerRecorder;
using tests::Process;
using tests::StatusRecorder;
using tests::TestDeployment;

const char* const chain = R"(
  - {name: front, kind: simulated, parameters: {rate_hz: 20}}
  - {name: walls, kind: segmentation, input: front, method: iepf}
  - {name: wctls, kind: line_fitting, input: walls, method: wctls}
  - {name: corners, kind: corner_estimation, input: wctls, method: adjacent}
)";
const std::string front_topic = "/front/scan";
const std::string corners_topic = "/corners/corners";

/// A deployment behind closed doors, with all of its keys.
class ClosedDeployment : public TestDeployment {
 public:
  explicit ClosedDeployment(bool encrypt = true)
      : TestDeployment(chain, std::string("security: {keys: keys, encrypt: ") +
                                  (encrypt ? "true" : "false") + "}\n") {
    make_keys(keys());
  }

  [[nodiscard]] std::filesystem::path keys() const { return directory().path() / "keys"; }

  void make_keys(const std::filesystem::path& folder) const {
    deploy::make_key_directory(folder, 1, false);
    for (const std::string& identity : deploy::identities_of(deployment())) {
      add(folder, identity, {deploy::rule_of(deployment(), identity)});
    }
  }

  void add(const std::filesystem::path& folder, const std::string& identity,
           const std::vector<deploy::TopicRule>& rules,
           deploy::Validity validity = deploy::valid_for_days(1)) const {
    const deploy::KeyPair authority = deploy::load_authority(folder);
    deploy::add_identity(folder, authority, identity, validity, false);
    deploy::write_permissions(folder, authority, identity, deploy::valid_for_days(1), rules);
  }

  /// Takes part with the keys of any folder, or with none; nothing is checked before.
  [[nodiscard]] runtime::ParticipantConfig intruder(
      const std::string& name, const std::optional<std::filesystem::path>& folder) const {
    runtime::ParticipantConfig config{deployment().domain, name, {}};
    if (folder) config.security = deploy::SecurityConfig{*folder, true};
    config.identity = name;
    return config;
  }

  [[nodiscard]] std::string name_space() const { return deployment().name_space; }
};

/// Writes scans and requests, and reads corners, as far as it gets.
class Intruder {
 public:
  Intruder(const ClosedDeployment& deployment, const std::string& name,
           const std::optional<std::filesystem::path>& folder)
      : name_(name),
        participant_(deployment.intruder(name, folder)),
        scans_(participant_, deployment.name_space() + front_topic, runtime::QosPreset::sensor),
        requests_(participant_, deploy::control_request_topic(deployment.name_space()),
                  runtime::QosPreset::control),
        corners_(participant_, deployment.name_space() + corners_topic,
                 runtime::QosPreset::feature) {}

  void act() {
    msg::Scan scan;
    scan.header().sensor(name_);
    scan.header().sequence_number(number_++);
    (void)scans_.write(scan);
    msg::ControlRequest request;
    request.service("wctls");
    request.requester(name_);
    request.action(msg::ControlAction::CONTROL_SWAP_METHOD);
    request.method("pca");
    (void)requests_.write(request);
    msg::Corners corners;
    while (corners_.take(corners)) ++heard_;
  }

  [[nodiscard]] const std::string& name() const { return name_; }
  [[nodiscard]] std::size_t heard() const { return heard_; }
  [[nodiscard]] std::size_t matched() const {
    return scans_.matched() + requests_.matched() + corners_.matched();
  }

 private:
  std::string name_;
  runtime::Participant participant_;
  runtime::Writer<msg::Scan> scans_;
  runtime::Writer<msg::ControlRequest> requests_;
  runtime::Reader<msg::Corners> corners_;
  std::uint64_t number_ = 0;
  std::size_t heard_ = 0;
};

TEST(Security, OnlyTheInvitedReadAndWrite) {
  const ClosedDeployment deployment;
  const auto other_keys = deployment.directory().path() / "other";
  deployment.make_keys(other_keys);
  const deploy::TopicRule own{deployment.deployment().domain, {"elsewhere"}, {"elsewhere"}};
  // Fast DDS looks up its own permissions without regard to the domain, but those of others with:
  // with rules for another domain an intruder passes its own checks, and meets those of the
  // services.
  const deploy::TopicRule foreign{deployment.deployment().domain + 1,
                                  {deployment.name_space() + "/*"},
                                  {deployment.name_space() + "/*"}};
  deployment.add(deployment.keys(), "foreign_topic", {own, foreign});
  deployment.add(other_keys, "other_authority",
                 {foreign, {own.domain, foreign.writes, foreign.reads}});
  // Valid when its participant starts, as Fast DDS asks for, and no longer when the services meet
  // it.
  const auto end = std::chrono::system_clock::now() + 2s;
  deployment.add(deployment.keys(), "expired", {{own.domain, foreign.writes, foreign.reads}},
                 {end - 24h, end});

  std::vector<std::unique_ptr<Intruder>> intruders;
  const auto add = [&](const std::string& name, const std::optional<std::filesystem::path>& keys) {
    intruders.push_back(std::make_unique<Intruder>(deployment, name, keys));
  };
  add("no_identity", std::nullopt);
  add("other_authority", other_keys);
  add("expired", deployment.keys());
  add("foreign_topic", deployment.keys());
  ASSERT_TRUE(tests::eventually([&] { return std::chrono::system_clock::now() > end + 1s; }));

  runtime::Participant participant(deployment.participant("quoin-operator"));
  CornerRecorder recorder(participant, deployment, "corners");
  std::vector<Process> processes;
  for (const auto& service : deployment.deployment().services) {
    processes.push_back(deployment.start(service.name, service.name == "corners" ? 1 : 0));
  }
  // Heartbeats come from every service, so each has been discovered by everybody by then.
  ASSERT_TRUE(recorder.wait_for(10));
  for (int round = 0; round < 20; ++round) {
    for (auto& intruder : intruders) intruder->act();
    ASSERT_TRUE(recorder.wait_for(recorder.poll() + 2));
  }
  for (auto& intruder : intruders) {
    intruder->act();
    EXPECT_EQ(intruder->heard(), 0U) << intruder->name();
    EXPECT_EQ(intruder->matched(), 0U) << intruder->name();
  }
  for (const msg::Corners& message : recorder.messages()) {
    EXPECT_EQ(message.header().sensor(), "front");
    EXPECT_EQ(message.header().trace()[2].method(), "wctls");
  }
  EXPECT_EQ(recorder.accounting().lost(), 0U);
  for (const Process& process : processes) {
    std::cerr << process.errors() << "=====\n";
  }
}

}  // namespace
}  // namespace quoin
