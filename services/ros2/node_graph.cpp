// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/ros2/node_graph.hpp"

#include <algorithm>
#include <idl/ros2/RmwDdsCommon.h>

namespace quoin::ros2 {

namespace {

namespace wire = rmw_dds_common::msg::dds_;

// What is behind the 16 bytes of RTPS is zero.
template <class WireGid>
WireGid wire_gid(const Gid& gid) {
  WireGid wired;
  wired.data().fill(0);
  std::ranges::copy(gid, wired.data().begin());
  return wired;
}

template <class Info, class NodeInfo, class WireGid>
void encode_as(const NodeGraph& graph, topics::RawMessage& raw) {
  Info info;
  info.gid(wire_gid<WireGid>(graph.participant));
  for (const GraphNode& node : graph.nodes) {
    NodeInfo& made = info.node_entities_info_seq().emplace_back();
    made.node_namespace(node.name_space);
    made.node_name(node.name);
    for (const Gid& gid : node.readers) made.reader_gid_seq().push_back(wire_gid<WireGid>(gid));
    for (const Gid& gid : node.writers) made.writer_gid_seq().push_back(wire_gid<WireGid>(gid));
  }
  topics::encode(info, raw);
}

}  // namespace

std::string node_name(const std::string& label) {
  std::string name = label;
  std::ranges::replace_if(
      name, [](unsigned char c) { return c >= 0x80 || std::isalnum(c) == 0; }, '_');
  return name;
}

NodeGraph node_graph(const Gid& participant, const std::string& name_space,
                     std::span<const std::string> labels,
                     std::span<const runtime::OwnedEndpoint> endpoints) {
  NodeGraph graph{participant, {}};
  for (const std::string& label : labels) {
    GraphNode& node = graph.nodes.emplace_back();
    node.name_space = "/" + name_space;
    node.name = node_name(label);
    for (const runtime::OwnedEndpoint& endpoint : endpoints) {
      if (endpoint.owner != label) continue;
      (endpoint.writes ? node.writers : node.readers).push_back(endpoint.guid);
    }
  }
  return graph;
}

void encode(const NodeGraph& graph, RosDistro distro, topics::RawMessage& raw) {
  if (distro == RosDistro::humble) {
    encode_as<wire::ParticipantEntitiesInfo24_, wire::NodeEntitiesInfo24_, wire::Gid24_>(graph,
                                                                                         raw);
  } else {
    encode_as<wire::ParticipantEntitiesInfo_, wire::NodeEntitiesInfo_, wire::Gid_>(graph, raw);
  }
}

}  // namespace quoin::ros2
