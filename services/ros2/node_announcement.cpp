// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
//
// Of every program of a service, where the deployment has `ros:`: tells ROS 2 which nodes are in
// this process.
#include <string>
#include <vector>

#include "services/ros2/node_graph.hpp"
#include "services/ros2/topics.hpp"
#include "services/runtime/dds/endpoints.hpp"
#include "services/runtime/process/run_process.hpp"

namespace quoin::ros2 {

namespace {

constexpr auto graph_type = "rmw_dds_common/msg/ParticipantEntitiesInfo";

// Late participants get the newest message. Humble knows no hashes, and has another type.
runtime::TopicQos graph_qos(RosDistro distro) {
  runtime::TopicQos qos = writer_qos(topic_type(graph_type));
  if (distro == RosDistro::humble) qos.user_data.clear();
  return qos;
}

/// Keeps what is announced up to date as the services make readers and writers.
class NodeAnnouncement {
 public:
  NodeAnnouncement(runtime::Participant& participant, const Deployment& deployment,
                   std::vector<std::string> labels)
      : participant_(participant),
        distro_(*deployment.ros),
        name_space_(deployment.name_space),
        labels_(std::move(labels)),
        writer_(participant, graph_topic, dds_type_name(graph_type), graph_qos(distro_)) {
    participant_.watch_endpoints(
        [this](const std::vector<runtime::OwnedEndpoint>& endpoints) { announce(endpoints); });
  }
  ~NodeAnnouncement() { participant_.watch_endpoints(nullptr); }
  NodeAnnouncement(const NodeAnnouncement&) = delete;
  NodeAnnouncement& operator=(const NodeAnnouncement&) = delete;

 private:
  void announce(const std::vector<runtime::OwnedEndpoint>& endpoints) {
    encode(node_graph(participant_.guid(), name_space_, labels_, endpoints), distro_, raw_);
    (void)writer_.write(raw_);  // late readers get what the next change brings
  }

  runtime::Participant& participant_;
  const RosDistro distro_;
  const std::string name_space_;
  const std::vector<std::string> labels_;
  runtime::RawWriter writer_;
  topics::RawMessage raw_;
};

const runtime::Companion nodes(
    {.user_data = [](const Deployment& deployment) -> std::string {
       return deployment.ros ? participant_user_data : "";
     },
     .open = [](runtime::Participant& participant, const Deployment& deployment,
                const std::vector<const ServiceConfig*>& services) -> std::shared_ptr<void> {
       if (!deployment.ros) return nullptr;
       std::vector<std::string> labels;
       for (const ServiceConfig* service : services) labels.push_back(label(*service));
       return std::make_shared<NodeAnnouncement>(participant, deployment, std::move(labels));
     }});

}  // namespace

}  // namespace quoin::ros2
