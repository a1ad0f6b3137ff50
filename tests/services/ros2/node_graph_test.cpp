// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/ros2/node_graph.hpp"

#include <cstring>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace quoin::ros2 {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

Gid gid_of(std::uint8_t number) {
  Gid gid{};
  gid.fill(number);
  return gid;
}

TEST(NodeGraph, EachServiceIsANodeWithItsReadersAndWriters) {
  const std::vector<std::string> labels{"front", "walls", "ros"};
  const std::vector<runtime::OwnedEndpoint> endpoints{
      {gid_of(1), "front", false},
      {gid_of(2), "ros", true},
      {gid_of(3), "of another process", true},
      {gid_of(4), "ros", true},
  };
  const NodeGraph graph = node_graph(gid_of(9), "robot/quoin", labels, endpoints);
  EXPECT_EQ(graph.participant, gid_of(9));
  ASSERT_EQ(graph.nodes.size(), 3U);
  EXPECT_EQ(graph.nodes[0].name_space, "/robot/quoin");
  EXPECT_EQ(graph.nodes[0].name, "front");
  EXPECT_THAT(graph.nodes[0].readers, ElementsAre(gid_of(1)));
  EXPECT_THAT(graph.nodes[0].writers, IsEmpty());
  EXPECT_THAT(graph.nodes[1].readers, IsEmpty());
  EXPECT_THAT(graph.nodes[1].writers, IsEmpty());
  EXPECT_THAT(graph.nodes[2].writers, ElementsAre(gid_of(2), gid_of(4)));
}

TEST(NodeGraph, NamesOfNodesHaveLettersDigitsAndUnderscores) {
  EXPECT_EQ(node_name("walls_2"), "walls_2");
  EXPECT_EQ(node_name("front-left@20"), "front_left_20");
  EXPECT_EQ(node_name("\xC3\xA4"), "__");
}

// A participant with one node that has one writer, written down by hand.
std::vector<std::uint8_t> bytes_of(RosDistro distro) {
  NodeGraph graph{gid_of(0x11), {}};
  graph.nodes.push_back({"/q", "abc", {}, {gid_of(0x22)}});
  topics::RawMessage raw;
  encode(graph, distro, raw);
  std::vector<std::uint8_t> bytes(raw.cdr.size());
  std::memcpy(bytes.data(), raw.cdr.data(), bytes.size());
  return bytes;
}

std::vector<std::uint8_t> expected(std::size_t behind_gid) {
  std::vector<std::uint8_t> bytes{0, 1, 0, 0};  // little-endian XCDR1
  const auto add = [&](std::initializer_list<std::uint8_t> more) {
    bytes.insert(bytes.end(), more);
  };
  const auto add_gid = [&](std::uint8_t number) {
    bytes.insert(bytes.end(), 16, number);
    bytes.insert(bytes.end(), behind_gid, 0);
  };
  add_gid(0x11);
  add({1, 0, 0, 0});                    // one node
  add({3, 0, 0, 0, '/', 'q', 0, 0});    // its namespace with the zero at its end, and one to fill
  add({4, 0, 0, 0, 'a', 'b', 'c', 0});  // its name
  add({0, 0, 0, 0});                    // no reader
  add({1, 0, 0, 0});                    // one writer
  add_gid(0x22);
  return bytes;
}

TEST(NodeGraph, GidsHaveTwentyFourBytesUpToHumbleAndSixteenFromIronOn) {
  EXPECT_EQ(bytes_of(RosDistro::humble), expected(8));
  EXPECT_EQ(bytes_of(RosDistro::iron), expected(0));
  EXPECT_EQ(bytes_of(RosDistro::jazzy), expected(0));
  EXPECT_EQ(bytes_of(RosDistro::rolling), expected(0));
}

}  // namespace
}  // namespace quoin::ros2
