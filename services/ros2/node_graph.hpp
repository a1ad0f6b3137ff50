// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <vector>

#include "services/deployment/deployment.hpp"
#include "services/runtime/dds/participant.hpp"
#include "services/topics/cdr_codec.hpp"

namespace quoin::ros2 {

using Gid = runtime::Guid;

/// A node of ROS 2 with its readers and writers.
struct GraphNode {
  std::string name_space;  ///< "/quoin"
  std::string name;
  std::vector<Gid> readers;
  std::vector<Gid> writers;

  friend bool operator==(const GraphNode&, const GraphNode&) = default;
};

/// What a participant says of the nodes in it (rmw_dds_common/ParticipantEntitiesInfo).
struct NodeGraph {
  Gid participant{};
  std::vector<GraphNode> nodes;

  friend bool operator==(const NodeGraph&, const NodeGraph&) = default;
};

/// The topic of DDS that all participants of ROS 2 write theirs to; it has no rt/ before it.
inline constexpr auto graph_topic = "ros_discovery_info";
/// What a participant of ROS 2 has as user data: the enclave of its keys, of which there are none.
inline constexpr auto participant_user_data = "enclave=/;";

/// A name that ROS 2 takes for that of a node: letters, digits and _; what else a label has ("@" of
/// instances, "-") becomes _.
[[nodiscard]] std::string node_name(const std::string& label);

/// One node a service, named by its label, with the `endpoints` that have it as owner.
[[nodiscard]] NodeGraph node_graph(const Gid& participant, const std::string& name_space,
                                   std::span<const std::string> labels,
                                   std::span<const runtime::OwnedEndpoint> endpoints);

/// The message as that distribution has it: a Gid has 24 bytes up to Humble, 16 from Iron on. Only
/// the bytes of `raw` are set.
void encode(const NodeGraph& graph, RosDistro distro, topics::RawMessage& raw);

}  // namespace quoin::ros2
