// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <stdlib.h>

#include <gmock/gmock.h>

#include "deploy/kinds/kinds.hpp"
#include "services/deployment/deployment.hpp"
#include "services/deployment/graph.hpp"
#include "tests/temporary_folder.hpp"

namespace quoin {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

std::vector<std::string> names_of(const Deployment& deployment) {
  std::vector<std::string> names;
  for (const ServiceConfig& service : deployment.services) names.push_back(service.name);
  return names;
}

constexpr auto chain = R"(version: 1
services:
  - {name: corners, kind: corner_estimation, input: lines}
  - {name: lines, kind: line_fitting, input: walls}
  - {name: front, kind: simulated}
  - {name: walls, kind: segmentation, input: front}
  - {name: rear, kind: simulated}
)";

TEST(Reader, FillsInDefaults) {
  const Deployment deployment = deploy::parse_deployment(chain, "robot.yaml");
  EXPECT_EQ(deployment.file, "robot.yaml");
  EXPECT_EQ(deployment.name_space, "quoin");
  EXPECT_EQ(deployment.domain, 0);
  const ServiceConfig& lines = deployment.service("lines");
  EXPECT_EQ(lines.kind, "line_fitting");
  EXPECT_EQ(lines.input("segments"), "walls");
  EXPECT_FALSE(lines.method.empty());
  EXPECT_EQ(lines.outputs.front().qos, "feature");
  EXPECT_EQ(lines.restart, RestartPolicy::always);
  EXPECT_THAT(lines.parameters, testing::IsEmpty());
  EXPECT_EQ(lines.position.line, 4);
  EXPECT_EQ(lines.position.column, 5);
  EXPECT_EQ(deployment.service("front").outputs.front().qos, "sensor");
  EXPECT_EQ(deployment.service("front").method, "");
}

TEST(Reader, ReadsWhereServicesRunAndHowTheyMeet) {
  const Deployment deployment = deploy::parse_deployment(R"(
version: 1
network:
  interfaces: [eth0, 10.7.0.0/24]
  servers: [10.7.0.2, "10.7.0.3:11899"]
services:
  - {name: front, kind: simulated, host: lidar}
  - {name: walls, kind: segmentation, input: front, host: compute, strength: 1}
  - {name: walls, kind: segmentation, input: front, host: base-2, strength: 20}
)",
                                                         "/etc/robot.yaml");
  EXPECT_THAT(deployment.network.interfaces, ElementsAre("eth0", "10.7.0.0/24"));
  EXPECT_EQ(deployment.network.discovery, Discovery::server);
  EXPECT_THAT(deployment.network.servers,
              ElementsAre(ServerAddress{"10.7.0.2", 11811}, ServerAddress{"10.7.0.3", 11899}));
  EXPECT_THAT(names_of(deployment), ElementsAre("front", "walls", "walls"));
  EXPECT_EQ(deployment.service("front").host, "lidar");
  EXPECT_EQ(label(deployment.service("walls")), "walls@20");
  EXPECT_EQ(deployment.service("walls@1").host, "compute");
  EXPECT_THROW((void)deployment.service("walls@2"), std::out_of_range);
}

TEST(Reader, ReadsWhereTheKeysAre) {
  const std::string text =
      "version: 1\n"
      "security: {keys: keys, encrypt: false}\n"
      "services:\n"
      "  - {name: front, kind: simulated}\n";
  const Deployment deployment = deploy::parse_deployment(text, "/etc/robot.yaml");
  ASSERT_TRUE(deployment.security.has_value());
  EXPECT_EQ(deployment.security->directory, "/etc/keys");
  EXPECT_FALSE(deployment.security->encrypt);
  // However the file is named: what runs is compared with what is applied.
  const Deployment relative = deploy::parse_deployment(text, "robot.yaml");
  EXPECT_EQ(relative.security->directory, std::filesystem::current_path() / "keys");
}

TEST(Reader, ReadsWhoseGraphOfNodesShowsTheServices) {
  const auto ros = [](const std::string& line) {
    return deploy::parse_deployment(
               "version: 1\n" + line + "services:\n  - {name: front, kind: simulated}\n",
               "robot.yaml")
        .ros;
  };
  EXPECT_EQ(ros(""), std::nullopt);
  EXPECT_EQ(ros("ros: {distro: humble}\n"), RosDistro::humble);
  EXPECT_EQ(ros("ros: {distro: iron}\n"), RosDistro::iron);
  EXPECT_EQ(ros("ros: {distro: jazzy}\n"), RosDistro::jazzy);
  EXPECT_EQ(ros("ros: {distro: rolling}\n"), RosDistro::rolling);
}

TEST(Reader, FindsOthersByMulticastWhereNothingElseIsSaid) {
  const auto discovery = [](const std::string& network) {
    return deploy::parse_deployment(
               "version: 1\n" + network + "services:\n  - {name: front, kind: simulated}\n",
               "robot.yaml")
        .network.discovery;
  };
  EXPECT_EQ(discovery(""), Discovery::peers);  // on the loopback interface
  EXPECT_EQ(discovery("network: {interfaces: eth0}\n"), Discovery::multicast);
  EXPECT_EQ(discovery("network: {interfaces: eth0, peers: 10.7.0.1}\n"), Discovery::peers);
  EXPECT_EQ(discovery("network: {servers: 127.0.0.1}\n"), Discovery::server);
}

TEST(Reader, KeepsParticipantsLongerOnANetworkUnlessTold) {
  EXPECT_EQ(parse_network({}).lease, loopback_lease);
  EXPECT_EQ(parse_network({{"eth0"}, "", {}, {}}).lease, network_lease);
  const Deployment told = deploy::parse_deployment(
      "version: 1\nnetwork: {interfaces: eth0, lease: 500 ms}\n"
      "services:\n  - {name: front, kind: simulated}\n",
      "robot.yaml");
  EXPECT_EQ(told.network.lease, 0.5);
}

TEST(Reader, ReadsANetworkThatNoFileDescribes) {
  const NetworkConfig network =
      parse_network({{"eth0", "10.7.0.0/24"}, "", {}, {"10.7.0.2:11899"}});
  EXPECT_THAT(network.interfaces, ElementsAre("eth0", "10.7.0.0/24"));
  EXPECT_EQ(network.discovery, Discovery::server);
  EXPECT_THAT(network.servers, ElementsAre(ServerAddress{"10.7.0.2", 11899}));
  EXPECT_EQ(parse_network({}), NetworkConfig{});
  try {
    (void)parse_network({{"eth0"}, "server", {}, {}});
    ADD_FAILURE();
  } catch (const DeploymentError& error) {
    EXPECT_THAT(error.messages(), ElementsAre(testing::StartsWith("discovery: server needs")));
  }
}

TEST(Reader, TellsTheHostsThatServicesName) {
  EXPECT_THAT(hosts_of(deploy::parse_deployment(chain, "robot.yaml")), testing::IsEmpty());
  EXPECT_THAT(hosts_of(deploy::parse_deployment(R"(
version: 1
services:
  - {name: front, kind: simulated, host: lidar}
  - {name: walls, kind: segmentation, input: front, host: compute}
  - {name: rear, kind: simulated, host: lidar}
)",
                                                "robot.yaml")),
              ElementsAre("lidar", "compute"));
}

TEST(Reader, PutsInputsFirstAndElseKeepsTheOrder) {
  EXPECT_THAT(names_of(deploy::parse_deployment(chain, "robot.yaml")),
              ElementsAre("front", "walls", "lines", "corners", "rear"));
}

TEST(Reader, ReadsEverythingThatCanBeWritten) {
  const Deployment deployment = deploy::parse_deployment(R"(
version: 1
namespace: fleet/robot_1
domain: 232
qos: lossless
services:
  - name: front
    kind: simulated
    qos: sensor
    restart: never
    parameters:
      environment: domestic_room
      rate_hz: 20 Hz
      range_stddev: 10 mm
      seed: "3"
  - {name: walls, kind: segmentation, input: front, method: iepf}
)",
                                                         "robot.yaml");
  EXPECT_EQ(deployment.name_space, "fleet/robot_1");
  EXPECT_EQ(deployment.domain, 232);
  const ServiceConfig& front = deployment.service("front");
  EXPECT_EQ(front.qos, "sensor");
  EXPECT_EQ(front.restart, RestartPolicy::never);
  EXPECT_THAT(front.parameters, ElementsAre(ParameterSetting{"environment", "domestic_room"},
                                            ParameterSetting{"rate_hz", "20 Hz"},
                                            ParameterSetting{"range_stddev", "10 mm"},
                                            ParameterSetting{"seed", "3"}));
  EXPECT_EQ(deployment.service("walls").qos, "lossless");
  EXPECT_EQ(deployment.service("walls").method, "iepf");
}

TEST(Reader, TheSensorOfASourceHasABlock) {
  const Deployment deployment = deploy::parse_deployment(R"(
version: 1
services:
  - name: front
    kind: simulated
    sensor: {range_stddev: 2 mm, range_stddev_per_metre: 1 %, flatness_stddev: 3 mm, noise: estimated}
    parameters: {seed: 3}
)",
                                                         "robot.yaml");
  EXPECT_THAT(deployment.service("front").parameters,
              ElementsAre(ParameterSetting{"seed", "3"}, ParameterSetting{"range_stddev", "2 mm"},
                          ParameterSetting{"range_stddev_per_metre", "1 %"},
                          ParameterSetting{"flatness_stddev", "3 mm"},
                          ParameterSetting{"noise", "estimated"}));
}

TEST(Reader, ThePresetForAllMayBeWrittenLast) {
  const Deployment deployment = deploy::parse_deployment(
      "version: 1\nservices:\n  - {name: front, kind: simulated}\nqos: lossless\n", "robot.yaml");
  EXPECT_EQ(deployment.service("front").qos, "lossless");
}

TEST(Reader, ReplacesEnvironmentVariablesInParameters) {
  ::setenv("QUOIN_TEST_FOLDER", "/data", 1);
  const Deployment deployment = deploy::parse_deployment(
      "version: 1\nservices:\n"
      "  - {name: log, kind: replay, parameters: {path: \"${QUOIN_TEST_FOLDER}/a\", frame: "
      "\"${QUOIN_NONE:-f}\"}}\n",
      "robot.yaml");
  ::unsetenv("QUOIN_TEST_FOLDER");
  EXPECT_THAT(deployment.service("log").parameters,
              ElementsAre(ParameterSetting{"path", "/data/a"}, ParameterSetting{"frame", "f"}));
}

TEST(Reader, ChecksValuesFromTheEnvironmentToo) {
  EXPECT_THROW((void)deploy::parse_deployment(
                   "version: 1\nservices:\n"
                   "  - {name: log, kind: replay, parameters: {rate_hz: \"${QUOIN_NONE:-x}\"}}\n",
                   "robot.yaml"),
               DeploymentError);
}

TEST(Reader, ReadsFilesWithWindowsLineEnds) {
  std::string text = chain;
  for (std::size_t at = text.find('\n'); at != std::string::npos; at = text.find('\n', at + 2)) {
    text.insert(at, 1, '\r');
  }
  EXPECT_EQ(deploy::parse_deployment(text, "robot.yaml").services.size(), 5U);
}

TEST(Deployment, FindsServicesAndReaders) {
  const Deployment deployment = deploy::parse_deployment(chain, "robot.yaml");
  const Graph graph(deployment);
  EXPECT_THAT(graph.readers_of("walls"), ElementsAre(&deployment.service("lines")));
  EXPECT_THAT(graph.readers_of("corners"), testing::IsEmpty());
  try {
    (void)deployment.service("cornrs");
    FAIL() << "found";
  } catch (const std::out_of_range& error) {
    EXPECT_STREQ(error.what(), "robot.yaml: no service 'cornrs'; did you mean 'corners'?");
  }
}

// A service knows its own kind only, and must read others as they write.
TEST(Deployment, IsReadByAServiceAsByAllOthers) {
  const std::string text = std::string("qos: lossless\n") + chain;
  const Deployment whole = deploy::parse_deployment(text, "robot.yaml");
  for (const ServiceConfig& service : whole.services) {
    const Deployment own = parse_deployment(text, "robot.yaml", {{service.info}, false});
    const ServiceConfig& config = own.service(service.name);
    EXPECT_EQ(config.outputs, service.outputs) << service.name;
    const auto seen = Graph(own).inputs_of(config);
    const auto expected = Graph(whole).inputs_of(service);
    ASSERT_EQ(seen.size(), expected.size()) << service.name;
    for (std::size_t i = 0; i < seen.size(); ++i) {
      EXPECT_EQ(seen[i].output, expected[i].output) << service.name;
      EXPECT_EQ(seen[i].output.qos, "lossless") << service.name;
      EXPECT_EQ(seen[i].writer->lease, expected[i].writer->lease) << service.name;
    }
    EXPECT_EQ(Graph(own).expected_readers(config), Graph(whole).expected_readers(service))
        << service.name;
  }
}

TEST(Deployment, HasOutputsThatAParameterAsksFor) {
  const Deployment deployment = deploy::parse_deployment(R"(version: 1
services:
  - {name: quiet, kind: simulated}
  - {name: front, kind: simulated, parameters: {truth: true}}
)",
                                                         "robot.yaml");
  EXPECT_EQ(deployment.service("quiet").outputs.size(), 1U);
  const std::vector<OutputConfig>& outputs = deployment.service("front").outputs;
  ASSERT_EQ(outputs.size(), 2U);
  EXPECT_EQ(outputs[1].topic, "quoin/front/pose");
  EXPECT_EQ(Graph(deployment).ends().size(), 3U);
}

TEST(Deployment, NamesTopics) {
  const Deployment deployment = deploy::parse_deployment(chain, "robot.yaml");
  EXPECT_EQ(deployment.service("front").outputs.front().topic, "quoin/front/scan");
  EXPECT_EQ(deployment.service("walls").outputs.front().topic, "quoin/walls/segments");
  EXPECT_EQ(deployment.service("lines").outputs.front().topic, "quoin/lines/lines");
  EXPECT_EQ(deployment.service("corners").outputs.front().topic, "quoin/corners/corners");
  EXPECT_EQ(status_topic("a/b"), "a/b/status");
  EXPECT_EQ(control_request_topic("a"), "a/control/request");
  EXPECT_EQ(control_reply_topic("a"), "a/control/reply");
}

class Files : public testing::Test {
 protected:
  std::string error_of(const std::filesystem::path& file) {
    try {
      (void)deploy::load_deployment(file);
    } catch (const DeploymentError& error) {
      return error.what();
    }
    return "accepted";
  }

  const tests::TemporaryFolder temporary_;
  const std::filesystem::path folder_ = temporary_.path();
};

TEST_F(Files, ThatAreMissingOrNoFilesAreErrors) {
  EXPECT_THAT(error_of(folder_ / "none.yaml"), HasSubstr("none.yaml: no such file"));
  EXPECT_THAT(error_of(folder_), HasSubstr("is a directory"));
  EXPECT_THAT(error_of("/dev/null"), HasSubstr("is not a regular file"));
  EXPECT_THAT(error_of(""), HasSubstr("no such file"));
}

TEST_F(Files, ThatAreTooLargeAreErrors) {
  const auto file = folder_ / "large.yaml";
  std::ofstream(file) << chain << "#" << std::string(1024 * 1024, ' ');
  EXPECT_THAT(error_of(file), HasSubstr("larger than 256 KiB"));
}

TEST_F(Files, AreTextInUtf8) {
  const auto file = folder_ / "bytes.yaml";
  std::ofstream(file) << "# l\xC3\xA4ser\n" << chain;
  EXPECT_EQ(deploy::load_deployment(file).services.size(), 5U);
  std::ofstream(file) << "# l\xE4ser\n" << chain;
  EXPECT_THAT(error_of(file), HasSubstr("bytes.yaml:1:4: a byte that is no text"));
  std::ofstream(file) << chain << "# \x1b[2J\n";
  EXPECT_THAT(error_of(file), HasSubstr("a byte that is no text"));
}

TEST_F(Files, DoNotMakeErrorsThatMoveTheCursor) {
  const auto file = folder_ / "escape.yaml";
  std::ofstream(file) << "version: \"\\e[2J\"\nnamespace: \"a\\nb\"\n";
  const std::string error = error_of(file);
  EXPECT_THAT(error, HasSubstr("\\x1B[2J"));
  EXPECT_THAT(error, Not(HasSubstr("\x1b")));
}

TEST_F(Files, AreLoaded) {
  const auto file = folder_ / "robot.yaml";
  std::ofstream(file) << chain;
  EXPECT_EQ(deploy::load_deployment(file).services.size(), 5U);
  EXPECT_EQ(deploy::load_deployment(file).file, file);
}

}  // namespace
}  // namespace quoin
