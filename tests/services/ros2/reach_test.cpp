// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/ros2/reach.hpp"

#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/temporary_folder.hpp"

namespace quoin::ros2 {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

TEST(LookAround, FindsTheInterfacesWhereDdsDiscoveryIsListenedFor) {
  const tests::TemporaryFolder folder;
  const auto file = folder.path() / "igmp";
  std::ofstream(file) << "Idx\tDevice    : Count Querier\tGroup    Users Timer\tReporter\n"
                         "1\tlo        :     2      V3\n"
                         "\t\t\t\t0100FFEF     1 0:00000000\t\t0\n"
                         "\t\t\t\t010000E0     1 0:00000000\t\t0\n"
                         "2\teth0      :     2      V3\n"
                         "\t\t\t\t0100FFEF     1 0:00000000\t\t0\n"
                         "\t\t\t\t010000E0     1 0:00000000\t\t0\n"
                         "3\twlan0     :     1      V3\n"
                         "\t\t\t\t010000E0     1 0:00000000\t\t0\n";
  EXPECT_THAT(look_around(file).multicast_interfaces, ElementsAre("eth0"));
  EXPECT_THAT(look_around(folder.path() / "none").multicast_interfaces, IsEmpty());
}

struct Mended {
  const char* what;
  Deployment deployment;
  Surroundings surroundings;
  std::vector<std::string> lines;  // that the advice names, one an obstacle
};

Deployment on(std::vector<std::string> interfaces, Discovery discovery = Discovery::peers,
              int domain = 0) {
  Deployment deployment;
  deployment.domain = domain;
  deployment.network.interfaces = std::move(interfaces);
  deployment.network.discovery = discovery;
  return deployment;
}

TEST(Obstacles, EachNamesTheLineThatMendsIt) {
  const std::vector<Mended> cases{
      {"nobody else", on({}), {}, {}},
      {"both on loopback", on({}), {.discovery_range = "LOCALHOST"}, {}},
      {"both on loopback, Humble", on({}), {.localhost_only = "1"}, {}},
      {"ROS 2 on the network",
       on({}),
       {.multicast_interfaces = {"eth0", "wlan0"}},
       {"network: {interfaces: [eth0, wlan0], discovery: multicast}"}},
      {"the deployment on the network",
       on({"eth0"}, Discovery::multicast),
       {.discovery_range = "LOCALHOST"},
       {"ROS_AUTOMATIC_DISCOVERY_RANGE=SUBNET"}},
      {"both on the network",
       on({"eth0"}, Discovery::multicast),
       {.multicast_interfaces = {"eth0"}},
       {}},
      {"peers", on({"eth0"}), {}, {"network: {interfaces: [eth0], discovery: multicast}"}},
      {"off", on({"eth0"}, Discovery::multicast), {.discovery_range = "OFF"}, {"SUBNET"}},
      {"domains", on({"eth0"}, Discovery::multicast), {.domain_id = "7"}, {"domain: 7"}},
      {"same domain", on({"eth0"}, Discovery::multicast, 7), {.domain_id = "7"}, {}},
  };
  for (const Mended& each : cases) {
    const auto found = obstacles(each.deployment, each.surroundings);
    ASSERT_EQ(found.size(), each.lines.size()) << each.what;
    for (std::size_t i = 0; i < found.size(); ++i) {
      EXPECT_THAT(found[i].advice, HasSubstr(each.lines[i])) << each.what;
    }
  }
}

}  // namespace
}  // namespace quoin::ros2
