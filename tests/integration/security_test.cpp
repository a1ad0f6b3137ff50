// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <cstdio>
#include <idl/Control.h>
#include <idl/Lines.h>
#include <idl/Scan.h>
#include <idl/Segments.h>
#include <memory>
#include <optional>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "services/runtime/dds/endpoints.hpp"
#include "services/topics/header.hpp"
#include "tests/integration/harness/keys.hpp"

namespace quoin {
namespace {

using namespace std::chrono_literals;
using testing::HasSubstr;
using tests::CornerRecorder;
using tests::Process;
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
  explicit ClosedDeployment(const std::string& encrypt = "true")
      : TestDeployment(chain, "security: {keys: keys, encrypt: " + encrypt + "}\n") {
    tests::make_keys(*this);
  }

  [[nodiscard]] std::filesystem::path keys() const { return directory().path() / "keys"; }
  [[nodiscard]] std::string name_space() const { return deployment().name_space; }

  /// Takes part with the keys of any folder, or with none; nothing is checked before.
  [[nodiscard]] runtime::ParticipantConfig intruder(
      const std::string& name, const std::optional<std::filesystem::path>& folder) const {
    runtime::ParticipantConfig config{deployment().domain, name, {}};
    if (folder) config.security = SecurityConfig{*folder, true};
    config.identity = name;
    return config;
  }
};

/// Writes scans and requests, and reads corners, as far as it gets.
class Intruder {
 public:
  Intruder(const ClosedDeployment& deployment, const std::string& name,
           const std::optional<std::filesystem::path>& folder)
      : name_(name),
        participant_(deployment.intruder(name, folder)),
        scans_(participant_, deployment.name_space() + front_topic, runtime::QosPreset::sensor),
        requests_(participant_, control_request_topic(deployment.name_space()),
                  runtime::QosPreset::control),
        corners_(participant_, deployment.name_space() + corners_topic,
                 runtime::QosPreset::feature) {}

  void act() {
    msg::Scan scan;
    topics::set_origin(scan.header(), name_, 1, number_++);
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
  /// As services call it that refused its identity: Fast DDS 3 reports no name then.
  [[nodiscard]] std::string name_of_refused() const {
    if (runtime::dds_version().starts_with("Fast DDS 2")) return name_;
    std::string text;
    for (std::size_t i = 0; i < 12; ++i) {
      std::array<char, 4> digits{};
      std::snprintf(digits.data(), digits.size(), i == 0 ? "%02x" : ".%02x",
                    participant_.guid()[i]);
      text += digits.data();
    }
    return text;
  }
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

/// A participant whose certificate is valid when it starts, as Fast DDS asks for, and no longer
/// when this returns.
std::unique_ptr<Intruder> expired_intruder(const ClosedDeployment& deployment,
                                           const TopicRule& rule) {
  for (auto span = 2s; span < 60s; span *= 2) {  // longer on a machine that is busy
    const auto now = std::chrono::system_clock::now();
    const auto end = now + span;
    const std::string name = "expired_" + std::to_string(span.count());
    tests::add_keys(deployment.keys(), name, {rule}, {now - 24h, end});
    try {
      auto intruder = std::make_unique<Intruder>(deployment, name, deployment.keys());
      EXPECT_TRUE(
          tests::eventually([&] { return std::chrono::system_clock::now() > end + 1s; }, 60s));
      return intruder;
    } catch (const std::runtime_error&) {  // too late
    }
  }
  throw std::runtime_error("no participant starts in time");
}

/// A lossless topic from the identity of one service to that of another.
template <class T>
struct LosslessLink {
  LosslessLink(const ClosedDeployment& deployment, const std::string& from, const std::string& to)
      : sender(deployment.participant(from)),
        receiver(deployment.participant(to)),
        writer(sender, deployment.topic(from), runtime::QosPreset::lossless),
        reader(receiver, deployment.topic(from), runtime::QosPreset::lossless) {}

  runtime::Participant sender;
  runtime::Participant receiver;
  runtime::Writer<T> writer;
  runtime::Reader<T> reader;
};

// Samples that are sent again share messages, filled up to the last bytes that there are.
TEST(Security, SamplesThatAreSentAgainTogetherArrive) {
  const ClosedDeployment deployment;
  LosslessLink<msg::Segments> link(deployment, "walls", "wctls");
  ASSERT_TRUE(link.writer.wait_for_readers(1, 30s));

  // More than the reader keeps: it has to ask for the others again.
  constexpr std::size_t samples = 450;
  msg::Segments sample;
  msg::Segments taken;
  for (std::size_t length = 100; length < 900; length += 25) {
    for (std::size_t i = 0; i < samples; ++i) {
      topics::set_origin(sample.header(), std::string(length, 'x'), 1, i);
      // A full history is told at once when an acknowledgement comes that makes no room.
      ASSERT_TRUE(tests::eventually([&] { return link.writer.write(sample); })) << i;
    }
    std::size_t expected = 0;
    ASSERT_TRUE(tests::eventually([&] {
      while (link.reader.take(taken))
        EXPECT_EQ(topics::sequence_number(taken.header()), expected++);
      return expected == samples;
    })) << expected
        << " of " << length;
  }
}

void expect_samples_of_any_length(const std::string& encrypt) {
  const ClosedDeployment deployment(encrypt);
  LosslessLink<msg::Lines> link(deployment, "wctls", "corners");
  ASSERT_TRUE(link.writer.wait_for_readers(1, 30s));
  msg::Lines sample;
  sample.failures().resize(1);
  for (std::size_t length = 0; length < 8; ++length) {
    sample.failures()[0].reason(std::string(length, 'x'));  // the last of the sample
    ASSERT_TRUE(link.writer.write(sample));
    msg::Lines taken;
    ASSERT_TRUE(tests::eventually([&] { return link.reader.take(taken); })) << length;
    EXPECT_EQ(taken.failures().at(0).reason(), sample.failures()[0].reason());
  }
}

TEST(Security, SignedSamplesArriveWhateverTheirLength) { expect_samples_of_any_length("false"); }
TEST(Security, EncryptedSamplesArriveWhateverTheirLength) { expect_samples_of_any_length("true"); }

TEST(Security, OnlyTheInvitedReadAndWrite) {
  const ClosedDeployment deployment;
  const std::string name_space = deployment.name_space();
  const int domain = deployment.deployment().domain;
  const TopicRule everything{domain, {name_space + "/*"}, {name_space + "/*"}};
  const auto other_keys = deployment.directory().path() / "other";
  make_key_directory(other_keys, tests::days_of_keys, false);
  tests::add_keys(other_keys, "other_authority", {everything});
  tests::add_keys(deployment.keys(), "revoked", {everything});
  // Fast DDS looks up its own permissions without regard to the domain, but those of others with:
  // with rules for another domain this one passes its own checks and meets those of the services.
  tests::add_keys(
      deployment.keys(), "foreign_topic",
      {{domain, {"elsewhere"}, {"elsewhere"}}, {domain + 1, everything.writes, everything.reads}});

  std::vector<std::unique_ptr<Intruder>> intruders;
  const auto add = [&](const std::string& name, const std::optional<std::filesystem::path>& keys) {
    intruders.push_back(std::make_unique<Intruder>(deployment, name, keys));
  };
  add("no_identity", std::nullopt);
  add("other_authority", other_keys);
  add("revoked", deployment.keys());
  add("foreign_topic", deployment.keys());
  intruders.push_back(expired_intruder(deployment, everything));
  revoke_identity(deployment.keys(), load_authority(deployment.keys()), "revoked");

  runtime::Participant participant(deployment.participant("quoin-operator"));
  CornerRecorder recorder(participant, deployment, "corners");
  std::vector<Process> processes;
  for (const auto& service : deployment.deployment().services) {
    processes.push_back(deployment.start(service.name, service.name == "corners" ? 1 : 0));
  }
  ASSERT_TRUE(recorder.wait_for(1));
  const auto told = [&](std::size_t service, const std::string& intruder, const std::string& why) {
    const bool found = recorder.poll_until([&] {
      for (auto& each : intruders) each->act();
      const std::string errors = processes[service].errors();
      return errors.find("refused participant '" + intruder + "': " + why) != std::string::npos;
    });
    if (!found) ADD_FAILURE() << intruder << ": " << why << "\n" << processes[service].errors();
    return found;
  };
  const std::string identity = "its identity is ";
  const std::string any_cause = identity + "missing, foreign, expired or revoked";
  const bool tells_causes = runtime::dds_version().starts_with("Fast DDS 2");
  for (std::size_t service = 0; service < processes.size(); ++service) {
    const auto refused = [&](std::size_t intruder, const std::string& cause) {
      return told(service, intruders[intruder]->name_of_refused(),
                  tells_causes ? cause : any_cause);
    };
    EXPECT_TRUE(refused(0, "it has no identity"));
    // Where the other has to begin the handshake it never comes.
    if (tells_causes) {
      EXPECT_TRUE(refused(1, identity + "of another authority"));
    }
    EXPECT_TRUE(refused(2, any_cause));
    EXPECT_TRUE(refused(4, identity));
  }
  EXPECT_TRUE(told(1, "foreign_topic", "no permission to write " + name_space + front_topic));
  EXPECT_TRUE(
      told(2, "foreign_topic", "no permission to write " + name_space + "/control/request"));
  EXPECT_TRUE(told(3, "foreign_topic", "no permission to read " + name_space + corners_topic));

  // Whoever got through would have been heard by now.
  const std::size_t before = recorder.poll();
  ASSERT_TRUE(recorder.wait_for(before + 10));
  for (auto& intruder : intruders) {
    intruder->act();
    EXPECT_EQ(intruder->heard(), 0U) << intruder->name();
    EXPECT_EQ(intruder->matched(), 0U) << intruder->name();
  }
  for (const msg::Corners& message : recorder.messages()) {
    EXPECT_EQ(topics::source(message.header()), "front");
    EXPECT_EQ(message.header().trace()[2].method(), "wctls");
  }
  EXPECT_GT(recorder.messages().back().corners().size(), 0U);
  EXPECT_THAT(recorder.accounting().lost_by_site(), testing::IsEmpty());

  // With permissions, the same gets through: it reads. What it writes is not taken for what the
  // service does that lives.
  tests::add_keys(deployment.keys(), "guest", {everything});
  Intruder guest(deployment, "guest", deployment.keys());
  EXPECT_TRUE(tests::eventually([&] {
    guest.act();
    recorder.poll();
    return guest.heard() > 0 && guest.matched() > 0;
  }));
}

TEST(Security, TheOperatorChangesAndTheObserverLooks) {
  const ClosedDeployment deployment("false");  // signed only
  std::vector<Process> processes;
  for (const std::string service : {"front", "walls"})
    processes.push_back(deployment.start(service));
  Process status = deployment.quoin({"echo", "FILE", "walls", "--count", "1", "--json"});
  Process swap = deployment.quoin(
      {"swap", "walls", "split_and_merge", "--deployment", "FILE", "--wait", "20"});
  EXPECT_EQ(status.wait(30s), 0) << status.errors();
  EXPECT_THAT(status.output(), HasSubstr("\"segments\""));
  EXPECT_EQ(swap.wait(30s), 0) << swap.errors();

  runtime::Participant observer(deployment.participant("quoin-observer"));
  EXPECT_THROW(
      runtime::Writer<msg::ControlRequest>(observer, control_request_topic(deployment.name_space()),
                                           runtime::QosPreset::control),
      std::runtime_error);
}

TEST(Security, TheCommandMakesKeysAndNothingStartsWithoutThem) {
  const TestDeployment deployment(chain, "security: {keys: keys}\n");
  const auto quoin = [&](std::vector<std::string> arguments) {
    Process process = deployment.quoin(std::move(arguments));
    const int code = process.wait(30s).value_or(-1);
    return std::pair(code, process.output() + process.errors());
  };
  const std::string keys = (deployment.directory().path() / "keys").string();

  EXPECT_THAT(quoin({"up", "FILE"}),
              testing::Pair(2, HasSubstr("/keys/trust; copy trust of the key directory")));
  Process walls = deployment.start("walls");
  EXPECT_EQ(walls.wait(30s), 2);
  EXPECT_THAT(walls.errors(), HasSubstr("/identities/walls; quoin keys add"));

  EXPECT_THAT(quoin({"keys", "add", keys, "walls"}),
              testing::Pair(1, HasSubstr("quoin keys init")));
  EXPECT_THAT(quoin({"keys", "init", keys}), testing::Pair(0, HasSubstr("keep ")));
  EXPECT_THAT(quoin({"keys", "init", keys}), testing::Pair(1, HasSubstr("--force")));
  EXPECT_THAT(quoin({"keys", "add", keys}), testing::Pair(2, HasSubstr("--deployment FILE")));
  EXPECT_THAT(quoin({"keys", "add", keys, "--deployment", "FILE"}),
              testing::Pair(0, HasSubstr("identities/walls")));
  EXPECT_THAT(quoin({"keys", "add", keys, "walls", "stranger"}),
              testing::Pair(1, HasSubstr("--force")));
  EXPECT_THAT(quoin({"keys", "permissions", keys, "FILE"}),
              testing::Pair(0, HasSubstr("signed the permissions of 6 identities")));
  for (const std::string& identity : identities_of(deployment.deployment())) {
    EXPECT_NO_THROW((void)deployment.participant(identity)) << identity;
  }
  EXPECT_THAT(quoin({"keys", "revoke", keys, "walls"}), testing::Pair(0, HasSubstr("revoked.pem")));
  EXPECT_THROW((void)deployment.participant("walls"), DeploymentError);
}

}  // namespace
}  // namespace quoin
