// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include <gmock/gmock.h>
#include <yaml-cpp/yaml.h>

#include "deploy/export/compose.hpp"
#include "deploy/export/export_plan.hpp"
#include "deploy/export/output_file.hpp"
#include "deploy/export/systemd.hpp"
#include "deploy/export/systemd_text.hpp"
#include "deploy/export/visibility.hpp"
#include "deploy/kinds/kinds.hpp"
#include "tests/temporary_folder.hpp"

namespace quoin::deploy {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::SizeIs;
using testing::StartsWith;

constexpr const char* robot = R"(
version: 1
namespace: Fleet/robot1
services:
  - {name: device, kind: rplidar_emulator}
  - {name: front, kind: rplidar, parameters: {serial_port: auto}}
  - {name: rear, kind: rplidar, parameters: {serial_port: "tcp://127.0.0.1:20108"}}
  - {name: side, kind: simulated}
  - {name: walls, kind: segmentation, input: front}
  - {name: a, kind: line_fitting, input: walls, restart: never}
  - {name: "on", kind: line_fitting, input: walls}
)";

Deployment deployment(const std::string& text = robot,
                      const std::string& file = "/etc/quoin/robot.yaml") {
  return deploy::parse_deployment(text, file);
}

std::string text_of(const std::vector<UnitFile>& units, const std::string& name) {
  for (const UnitFile& unit : units) {
    if (unit.name == name) return unit.text;
  }
  return "no unit " + name;
}

TEST(SystemdText, KeepsWordsWhole) {
  EXPECT_EQ(unit_argument("/etc/robot.yaml"), "/etc/robot.yaml");
  EXPECT_EQ(unit_argument("wctls@5"), "wctls@5");
  EXPECT_EQ(unit_argument(""), "\"\"");
  EXPECT_EQ(unit_argument("a b"), "\"a b\"");
  EXPECT_EQ(unit_argument("100%"), "100%%");
  EXPECT_EQ(unit_argument("${HOME} $"), "\"$${HOME} $$\"");
  EXPECT_EQ(unit_argument("a\"b'c\\d"), "\"a\\\"b'c\\\\d\"");
  EXPECT_EQ(unit_argument("a\nExecStartPre=/bin/sh"), "\"a\\x0aExecStartPre=/bin/sh\"");
  EXPECT_EQ(unit_argument(";"), "\";\"");
  EXPECT_EQ(unit_word("$a%"), "$a%%");
  EXPECT_EQ(unit_program("/opt/my $quoin/100%"), "\"/opt/my $quoin/100%%\"");
  EXPECT_THROW((void)unit_program("/opt/\"q\""), std::invalid_argument);
  EXPECT_THROW((void)unit_program("/opt/a\nb"), std::invalid_argument);
  EXPECT_EQ(unit_comment("a\nb\\"), "a\\x0Ab\\ ");
}

TEST(ExportPlan, ReadersComeBeforeWhatTheyRead) {
  const Deployment read = deployment();
  const ExportPlan plan = plan_export(read, "");
  EXPECT_EQ(plan.id, "quoin-Fleet-robot1");
  ASSERT_THAT(plan.processes, SizeIs(7));
  for (const ExportedProcess& process : plan.processes) {
    SCOPED_TRACE(process.id);
    if (process.id == "front") {
      EXPECT_THAT(process.after, ElementsAre("walls", "device"));
      EXPECT_EQ(process.serial_port, "auto");
      EXPECT_FALSE(process.may_finish);
    }
    if (process.id == "rear") {
      EXPECT_FALSE(process.serial_port);
      EXPECT_TRUE(process.own_network);
    }
    if (process.id == "side") {
      EXPECT_TRUE(process.may_finish);
    }
    if (process.id == "walls") {
      EXPECT_THAT(process.after, ElementsAre("a", "on"));
    }
    if (process.id == "a") {
      EXPECT_THAT(process.after, IsEmpty());
    }
  }
}

constexpr const char* two_hosts = R"(
version: 1
services:
  - {name: front, kind: simulated, host: lidar}
  - {name: walls, kind: segmentation, input: front, host: compute}
  - {name: lines, kind: line_fitting, input: walls, host: compute, strength: 5}
  - {name: lines, kind: line_fitting, input: walls, host: lidar, strength: 2}
network: {interfaces: [eth0], discovery: multicast}
)";

TEST(ExportPlan, ServicesOfOneProcessAreOneUnit) {
  const Deployment read =
      deployment(std::string(robot) + "processes: {perception: [walls, \"on\"], sensor: [rear]}\n");
  const ExportPlan plan = plan_export(read, "");
  ASSERT_THAT(plan.processes, SizeIs(6));
  for (const ExportedProcess& process : plan.processes) {
    SCOPED_TRACE(process.id);
    if (process.id == "front") {
      EXPECT_THAT(process.after, ElementsAre("perception", "device"));
    }
    if (process.id == "perception") {
      EXPECT_EQ(process.program, "quoin-process");
      EXPECT_EQ(process.kind, "walls, on");
      EXPECT_THAT(process.after, ElementsAre("a"));
      EXPECT_THAT(process.arguments("/robot.yaml"),
                  ElementsAre("--deployment", "/robot.yaml", "--process", "perception"));
    }
    if (process.id == "sensor") {
      EXPECT_TRUE(process.own_network);
    }
  }
}

TEST(ExportPlan, TakesTheShareOfAHost) {
  const Deployment read = deployment(two_hosts);
  const ExportPlan plan = plan_export(read, "compute");
  ASSERT_THAT(plan.processes, SizeIs(2));
  EXPECT_EQ(plan.processes[0].id, "walls");
  EXPECT_THAT(plan.processes[0].after, ElementsAre("lines-5")) << "the other one is elsewhere";
  EXPECT_EQ(plan.processes[1].name, "lines@5");
  EXPECT_EQ(plan.processes[1].id, "lines-5");
}

TEST(ExportPlan, DiscoveryServersComeFirst) {
  const Deployment read = deployment(two_hosts);
  const ExportPlan plan = plan_export(read, "lidar", true);
  ASSERT_THAT(plan.processes, SizeIs(3));
  EXPECT_EQ(plan.processes[0].id, "discovery-server");
  for (const std::size_t i : {1, 2}) {
    EXPECT_THAT(plan.processes[i].after, testing::Contains("discovery-server"));
  }
  const auto units = systemd_units(plan, "/usr/bin");
  EXPECT_THAT(
      text_of(units, "quoin-quoin-discovery-server.service"),
      AllOf(HasSubstr("Type=exec\nExecStart=/usr/bin/quoin discovery /etc/quoin/robot.yaml\n"),
            Not(HasSubstr("WatchdogSec")), HasSubstr("After=network-online.target\n"),
            HasSubstr("\nRestartSec=21000ms\n")));
  const YAML::Node root = YAML::Load(compose_file(plan, {.image = "quoin"}));
  EXPECT_THAT(root["services"]["discovery-server"]["command"].as<std::vector<std::string>>(),
              ElementsAre("quoin", "discovery", "/etc/quoin/robot.yaml"));
}

TEST(Systemd, TheTargetWantsAllAndTheUnitsArePartOfIt) {
  const Deployment read = deployment();
  const auto units = systemd_units(plan_export(read, ""), "/usr/local/bin");
  ASSERT_THAT(units, SizeIs(8));
  EXPECT_EQ(units[0].name, "quoin-Fleet-robot1.target");
  EXPECT_THAT(units[0].text, AllOf(StartsWith(export_marker),
                                   HasSubstr("Wants=quoin-Fleet-robot1-front.service\n"),
                                   HasSubstr("WantedBy=multi-user.target\n")));
  const std::string walls = text_of(units, "quoin-Fleet-robot1-walls.service");
  EXPECT_THAT(walls, HasSubstr("PartOf=quoin-Fleet-robot1.target\n"));
  EXPECT_THAT(walls, HasSubstr("After=quoin-Fleet-robot1-a.service\n"));
  EXPECT_THAT(walls, HasSubstr("ExecStart=/usr/local/bin/quoin-segmentation --deployment "
                               "/etc/quoin/robot.yaml --service walls\n"));
  EXPECT_THAT(walls, AllOf(HasSubstr("Type=notify\n"), HasSubstr("WatchdogSec=10s\n"),
                           HasSubstr("DynamicUser=yes\n"), HasSubstr("PrivateDevices=yes\n"),
                           HasSubstr("IPAddressDeny=any\n"), Not(HasSubstr("dialout"))));
}

TEST(Systemd, OnlyTheBridgeReachesSerialPorts) {
  const Deployment read = deployment();
  const auto units = systemd_units(plan_export(read, ""), "/usr/local/bin");
  for (const UnitFile& unit : units) {
    SCOPED_TRACE(unit.name);
    const bool bridge = unit.name.ends_with("-front.service");
    EXPECT_EQ(unit.text.find("SupplementaryGroups=dialout\n") != std::string::npos, bridge);
    EXPECT_EQ(unit.text.find("DeviceAllow=char-ttyUSB rw\n") != std::string::npos, bridge);
    EXPECT_EQ(unit.text.find("PrivateDevices=no\n") != std::string::npos, bridge);
  }
  // That of a device on the network may reach it.
  EXPECT_THAT(text_of(units, "quoin-Fleet-robot1-rear.service"),
              AllOf(Not(HasSubstr("IPAddressDeny")), HasSubstr("AF_INET6")));
  const Deployment uart = deployment(R"(
version: 1
services: [{name: front, kind: rplidar, parameters: {serial_port: /dev/serial0}}]
)");
  EXPECT_THAT(systemd_units(plan_export(uart, ""), "/bin")[1].text,
              HasSubstr("DeviceAllow=/dev/serial0 rw\n"));
}

TEST(Systemd, RestartsAsTheDeploymentSays) {
  const Deployment read = deployment();
  const auto units = systemd_units(plan_export(read, ""), "/usr/local/bin");
  EXPECT_THAT(text_of(units, "quoin-Fleet-robot1-a.service"), HasSubstr("Restart=no\n"));
  EXPECT_THAT(text_of(units, "quoin-Fleet-robot1-on.service"),
              AllOf(HasSubstr("Restart=always\n"), HasSubstr("RestartSec=1000ms\n"),
                    HasSubstr("RestartPreventExitStatus=2 3\n")));
  EXPECT_THAT(text_of(units, "quoin-Fleet-robot1-side.service"), HasSubstr("Restart=on-failure\n"));
  // Its port may not be there yet.
  EXPECT_THAT(text_of(units, "quoin-Fleet-robot1-front.service"),
              AllOf(HasSubstr("Restart=always\n"), HasSubstr("RestartPreventExitStatus=3\n")));
}

TEST(Systemd, OnANetworkItWaitsForIt) {
  const Deployment read = deployment(two_hosts);
  const auto units = systemd_units(plan_export(read, "compute"), "/usr/local/bin");
  EXPECT_THAT(units[1].text,
              AllOf(HasSubstr("After=network-online.target\n"), Not(HasSubstr("IPAddressDeny"))));
  EXPECT_THAT(units[2].text, HasSubstr("--service lines@5\n"));
}

TEST(Systemd, PathsCannotAddDirectives) {
  const Deployment read = deployment(robot, "/etc/a b/50%\n[Service]\nUser=root\n\\.yaml");
  for (const UnitFile& unit : systemd_units(plan_export(read, ""), "/opt/quoin $x")) {
    EXPECT_THAT(unit.text, Not(HasSubstr("\nUser=root")));
    if (!unit.name.ends_with("walls.service")) continue;
    EXPECT_THAT(unit.text,
                HasSubstr("ExecStart=\"/opt/quoin $x/quoin-segmentation\" --deployment \"/etc/a b/"
                          "50%%\\x0a[Service]\\x0aUser=root\\x0a\\\\.yaml\" --service walls\n"));
  }
}

TEST(Compose, HasAContainerForEachService) {
  const Deployment read = deployment();
  const std::string text = compose_file(
      plan_export(read, ""), {.image = "registry/quoin:1", .serial_port = "/dev/ttyUSB3"});
  EXPECT_THAT(text, StartsWith(export_marker));
  const YAML::Node root = YAML::Load(text);
  EXPECT_EQ(root["name"].as<std::string>(), "quoin-fleet-robot1");
  const YAML::Node services = root["services"];
  ASSERT_EQ(services.size(), 7U);
  for (const auto& entry : services) {
    SCOPED_TRACE(entry.first.as<std::string>());
    const YAML::Node& service = entry.second;
    EXPECT_EQ(service["image"].as<std::string>(), "registry/quoin:1");
    EXPECT_EQ(service["network_mode"].as<std::string>(), "host");
    EXPECT_TRUE(service["init"].as<bool>());
    EXPECT_TRUE(service["read_only"].as<bool>());
    EXPECT_THAT(service["cap_drop"].as<std::vector<std::string>>(), ElementsAre("ALL"));
    EXPECT_THAT(service["security_opt"].as<std::vector<std::string>>(),
                ElementsAre("no-new-privileges:true"));
    EXPECT_EQ(service["stop_signal"].as<std::string>(), "SIGTERM");
    EXPECT_EQ(service["stop_grace_period"].as<std::string>(), "10s");
    EXPECT_FALSE(service["privileged"]);
    const YAML::Node mount = service["volumes"][0];
    EXPECT_EQ(mount["source"].as<std::string>(), "/etc/quoin");
    EXPECT_TRUE(mount["read_only"].as<bool>());
    EXPECT_EQ(service["command"][2].as<std::string>(),
              mount["target"].as<std::string>() + "/robot.yaml");
    const bool bridge = entry.first.as<std::string>() == "front";
    EXPECT_EQ(service["devices"].IsDefined(), bridge);
    EXPECT_EQ(service["group_add"].IsDefined(), bridge);
  }
  EXPECT_THAT(services["front"]["devices"].as<std::vector<std::string>>(),
              ElementsAre("/dev/ttyUSB3:/dev/ttyUSB3"));
  EXPECT_THAT(services["front"]["group_add"].as<std::vector<std::string>>(),
              ElementsAre("dialout"));
  EXPECT_THAT(services["walls"]["depends_on"].as<std::vector<std::string>>(),
              ElementsAre("a", "on"));
  EXPECT_EQ(services["walls"]["restart"].as<std::string>(), "unless-stopped");
  EXPECT_EQ(services["side"]["restart"].as<std::string>(), "on-failure");
  EXPECT_EQ(services["a"]["restart"].as<std::string>(), "no");
  EXPECT_THAT(services["walls"]["command"].as<std::vector<std::string>>(),
              ElementsAre("quoin-segmentation", "--deployment", "/etc/quoin/robot.yaml",
                          "--service", "walls"));
}

TEST(Compose, KeepsPathsAsTheyAre) {
  const Deployment read = deployment(robot, "/etc/a \"b\" $c\n#/ro\\bot.yaml");
  const YAML::Node root = YAML::Load(compose_file(plan_export(read, ""), {.image = "quoin"}));
  const YAML::Node walls = root["services"]["walls"];
  // Compose makes one $ of two.
  EXPECT_EQ(walls["volumes"][0]["source"].as<std::string>(), "/etc/a \"b\" $$c\n#");
  EXPECT_EQ(walls["command"][2].as<std::string>(), "/etc/quoin/ro\\bot.yaml");
}

TEST(Export, WithKeysOneUserRunsAll) {
  const Deployment read = deployment(R"(
version: 1
security: {keys: /etc/quoin_keys}
services: [{name: front, kind: simulated}]
)");
  const ExportPlan plan = plan_export(read, "");
  EXPECT_THAT(systemd_units(plan, "/bin")[1].text,
              AllOf(HasSubstr("\nUser=quoin\n"), Not(HasSubstr("DynamicUser"))));
  const YAML::Node mounts =
      YAML::Load(compose_file(plan, {.image = "quoin"}))["services"]["front"]["volumes"];
  ASSERT_EQ(mounts.size(), 2U);
  EXPECT_EQ(mounts[1]["target"].as<std::string>(), "/etc/quoin_keys");
}

class Files : public testing::Test {
 protected:
  const tests::TemporaryFolder temporary_;
  const std::filesystem::path folder_ = temporary_.path();
};

TEST_F(Files, OfOthersAreNotReplaced) {
  const auto file = folder_ / "robot.target";
  EXPECT_TRUE(may_replace(file)) << "not there";
  write_whole(file, std::string(export_marker) + "\n[Unit]\n");
  EXPECT_TRUE(may_replace(file));
  EXPECT_EQ(std::filesystem::status(file).permissions(), std::filesystem::perms(0644));
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder_), {}), 1)
      << "nothing is left of writing";
  std::ofstream(file) << "[Unit]\n";
  EXPECT_FALSE(may_replace(file));
  std::filesystem::create_symlink(file, folder_ / "link");
  EXPECT_FALSE(may_replace(folder_ / "link"));
  EXPECT_THROW(write_whole(folder_ / "missing" / "file", ""), std::runtime_error);
}

TEST_F(Files, ThatOtherUsersCannotReadAreNamed) {
  EXPECT_THAT(obstacle_to_others(folder_ / "missing", false), HasSubstr("is not there"));
  const auto file = folder_ / "robot.yaml";
  std::ofstream(file) << "version: 1\n";
  EXPECT_NE(obstacle_to_others(file, false), "") << "the folder is closed";
  EXPECT_EQ(obstacle_to_others("/etc/passwd", false), "");
  EXPECT_EQ(obstacle_to_others("/bin/sh", true), "");
  EXPECT_THAT(obstacle_to_others("/etc/passwd", true), HasSubstr("chmod o+rx"));
  EXPECT_THAT(obstacle_to_others("/etc/shadow", false), HasSubstr("chmod o+r"));
}

}  // namespace
}  // namespace quoin::deploy
