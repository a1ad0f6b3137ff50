// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/runtime/dds/interfaces.hpp"

#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace quoin::runtime {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

const std::vector<InterfaceAddress> robot{{"lo", "127.0.0.1"},
                                          {"eth0", "10.7.0.2"},
                                          {"eth0", "10.7.1.2"},
                                          {"eth1", "192.168.1.5"},
                                          {"wlan0", "10.8.0.2", false}};

/// What the error says.
std::string failure(const std::vector<std::string>& interfaces,
                    const std::vector<InterfaceAddress>& host) {
  try {
    (void)resolve_interfaces(interfaces, host);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "nothing was wrong";
}

TEST(Interfaces, AreFoundByNameAddressAndNetworkInTheOrderOfTheHost) {
  EXPECT_THAT(resolve_interfaces({"eth0"}, robot), ElementsAre("10.7.0.2", "10.7.1.2"));
  EXPECT_THAT(resolve_interfaces({"10.7.1.2"}, robot), ElementsAre("10.7.1.2"));
  EXPECT_THAT(resolve_interfaces({"10.7.0.0/24"}, robot), ElementsAre("10.7.0.2"));
  EXPECT_THAT(resolve_interfaces({"10.7.0.0/23"}, robot), ElementsAre("10.7.0.2", "10.7.1.2"));
  EXPECT_THAT(resolve_interfaces({"10.7.0.2/32"}, robot), ElementsAre("10.7.0.2"));
  EXPECT_THAT(resolve_interfaces({"192.168.1.200/24", "10.7.0.2", "eth0", "eth9"}, robot),
              ElementsAre("10.7.0.2", "10.7.1.2", "192.168.1.5"));
  EXPECT_THAT(resolve_interfaces({"0.0.0.0/0"}, robot),
              ElementsAre("127.0.0.1", "10.7.0.2", "10.7.1.2", "192.168.1.5"));
}

TEST(Interfaces, AreTheLoopbackAddressAloneWhereNoneIsNamed) {
  EXPECT_THAT(resolve_interfaces({}, robot), ElementsAre("127.0.0.1"));
}

TEST(Interfaces, OfAnotherHostAreAnErrorThatTellsWhatThisOneHas) {
  EXPECT_EQ(failure({"eth", "10.7.0.3", "10.9.0.0/16"}, robot),
            "this host has none of the interfaces eth, 10.7.0.3, 10.9.0.0/16; it has lo "
            "(127.0.0.1), eth0 (10.7.0.2), eth0 (10.7.1.2), eth1 (192.168.1.5), wlan0 (10.8.0.2); "
            "correct 'interfaces' of the network, or give it an address there");
  EXPECT_THAT(failure({"eth0"}, {}), testing::HasSubstr("it has no IPv4 address"));
}

TEST(Interfaces, AreUsedOnlyWithALink) {
  EXPECT_THAT(resolve_interfaces({"wlan0", "10.7.0.2"}, robot), ElementsAre("10.7.0.2"));
  EXPECT_THAT(failure({"wlan0"}, robot), testing::StartsWith("no link on wlan0 (10.8.0.2)"));
}

TEST(Interfaces, OfThisMachineHaveTheLoopbackAddress) {
  EXPECT_THAT(host_addresses(), testing::Contains(testing::Field(&InterfaceAddress::address,
                                                                 testing::Eq("127.0.0.1"))));
}

TEST(Interfaces, DecideWhichDiscoveryServersRunHere) {
  NetworkConfig network;
  network.servers = {{"10.7.0.2", 11811}, {"10.7.0.3", 11811}, {"10.7.0.2", 11812}};
  EXPECT_THAT(servers_here(network, {"127.0.0.1", "10.7.0.2"}), ElementsAre(0U, 2U));
  EXPECT_THAT(servers_here(network, {"10.7.0.4"}), IsEmpty());
}

}  // namespace
}  // namespace quoin::runtime
