// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/ros2/topics.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>

#include "core/parameters/parameter.hpp"
#include "services/topics/topic_types.hpp"

namespace quoin::ros2 {

namespace {

using runtime::QosPreset;

// The hashes are those of the definitions of Jazzy, which Humble and Rolling share.
constexpr std::array table{
    // Reliable serves readers of sensor data, which ask for best effort, and all others.
    TopicType{"sensor_msgs/msg/LaserScan",
              "64c191398013af96509d518dac71d5164f9382553fce5c1f8cca5be7924bd828", QosPreset::sensor,
              5},
    TopicType{"visualization_msgs/msg/MarkerArray",
              "86cb8800b6fb05b5eff1abd7a56f62a5641d3ae9a1c29e78e67e704f1d067dcf",
              QosPreset::feature, 10},
    TopicType{"geometry_msgs/msg/PoseWithCovarianceStamped",
              "26432f9803e43727d3c8f668d1fdb3c630f548af631e2f4e31382371bfea3b6e",
              QosPreset::feature, 10},
    TopicType{"nav_msgs/msg/Odometry",
              "3cc97dc7fb7502f8714462c526d369e35b603cfc34d946e3f2eda2766dfec6e0",
              QosPreset::feature, 10},
    TopicType{"nav_msgs/msg/OccupancyGrid",
              "8d348150c12913a31ee0ec170fbf25089e4745d17035792a1ba94d6f0bc0cfc7", QosPreset::state,
              1},
    TopicType{"tf2_msgs/msg/TFMessage",
              "e369d0f05a23ae52508854b66f6aa0437f3449d652e8cbf22d5abe85d020f087",
              QosPreset::feature, 100},
    TopicType{"diagnostic_msgs/msg/DiagnosticArray",
              "5a8a36efb05fb25070fa0fb3810290c0e6cd4862b54a8fb975a1ee8dc55a333e",
              QosPreset::feature, 10},
    TopicType{"rmw_dds_common/msg/ParticipantEntitiesInfo",
              "91a0593bacdcc50ea9bdcf849a938b128412cc1ea821245c663bcd26f83c295e", QosPreset::state,
              1},
    // Ours, under the names of idl/ros2/quoin_msgs.
    TopicType{"quoin_msgs/msg/Scan",
              "10ac883d248e55852ba0cfd61115e9554187c957286e01f315292b101dae9737", QosPreset::sensor,
              5},
    TopicType{"quoin_msgs/msg/Segments",
              "33cd1df6cc0bb300ecd96d99374b09891b01afb142977e35a4285747930a33a5",
              QosPreset::feature, 10},
    TopicType{"quoin_msgs/msg/Lines",
              "ed6853763295d43c85fa46a979da0ff93b4d996938d706ede401e02a0761e668",
              QosPreset::feature, 10},
    TopicType{"quoin_msgs/msg/Corners",
              "a055dd470eb73da605a230afc2192f411c640be99b02b17304902d7bc2db054a",
              QosPreset::feature, 10},
    TopicType{"quoin_msgs/msg/Circles",
              "9ca73273f86e8cd9e3c4e9f77fc2c07de52093d915d351d27a1dce3ad5501b9b",
              QosPreset::feature, 10},
    TopicType{"quoin_msgs/msg/Odometry",
              "1ef08a59ec72d5749590ca2e430fb648a466c0bec1079d36a21a76f930e4bfd4",
              QosPreset::feature, 10},
    TopicType{"quoin_msgs/msg/Pose",
              "bae7aa2c62c04c0a0789ccd229963bdb0c60c69572bf2409e343c621a1425a18",
              QosPreset::feature, 10},
    TopicType{"quoin_msgs/msg/LineMap",
              "b5d40c3486889a5d305b57c223cc8fa9aaf0feeb752e642a7090fc1bc2382677",
              QosPreset::feature, 10},
};

constexpr std::string_view before_type = "::msg::dds_::";

bool is_name(std::string_view part) {
  const auto letter = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
  };
  return !part.empty() && letter(part.front()) &&
         std::ranges::all_of(part, [&](char c) { return letter(c) || (c >= '0' && c <= '9'); });
}

}  // namespace

std::span<const TopicType> topic_types() { return table; }

const TopicType& topic_type(std::string_view name) {
  const auto row = std::ranges::find(table, name, &TopicType::name);
  if (row == table.end()) throw std::out_of_range("no ROS 2 type '" + std::string(name) + "'");
  return *row;
}

const TopicType& own_type(std::string_view type) {
  const topics::TopicType* row = topics::find_topic_type(type);
  if (row == nullptr) throw std::out_of_range("no topic type '" + std::string(type) + "'");
  const std::string_view dds_type = row->dds_type;
  return topic_type("quoin_msgs/msg/" + std::string(dds_type.substr(dds_type.rfind(':') + 1)));
}

std::string dds_type_name(std::string_view name) {
  const std::string_view package = name.substr(0, name.find('/'));
  const std::string_view type = name.substr(name.rfind('/') + 1);
  return std::string(package) + std::string(before_type) + std::string(type) + "_";
}

std::string ros_type_name(std::string_view dds_type) {
  const std::size_t found = dds_type.find(before_type);
  if (found == std::string_view::npos || !dds_type.ends_with('_')) return "";
  const std::string_view type = dds_type.substr(found + before_type.size());
  return std::string(dds_type.substr(0, found)) + "/msg/" +
         std::string(type.substr(0, type.size() - 1));
}

std::string dds_topic(std::string_view name) {
  std::string_view rest = name.starts_with('/') ? name.substr(1) : name;
  const std::string topic = "rt/" + std::string(rest);
  while (true) {
    const std::size_t slash = rest.find('/');
    if (!is_name(rest.substr(0, slash))) {
      throw std::invalid_argument("'" + std::string(name) +
                                  "' is no name of a ROS 2 topic; write letters, digits and _ "
                                  "between slashes, no digit first, such as /robot/scan");
    }
    if (slash == std::string_view::npos) return topic;
    rest.remove_prefix(slash + 1);
  }
}

void check_topic(const Deployment& deployment, const std::string& parameter,
                 const std::string& topic) {
  if (deployment.security) {
    throw std::invalid_argument(
        "ROS 2 has no keys of this deployment's security; run the ROS 2 kinds in a deployment "
        "without it");
  }
  try {
    (void)dds_topic(topic);
  } catch (const std::invalid_argument& error) {
    throw ParameterError(parameter, error.what());
  }
}

runtime::TopicQos writer_qos(const TopicType& type, const std::string& owner) {
  runtime::TopicQos qos = type.qos;
  qos.depth = type.depth;
  qos.user_data = "typehash=RIHS01_" + std::string(type.hash) + ";";
  qos.owner = owner;
  return qos;
}

runtime::TopicQos reader_qos(const TopicType& type, bool reliable, const std::string& owner) {
  runtime::TopicQos qos = reliable ? QosPreset::feature : QosPreset::best_effort;
  qos.user_data = writer_qos(type).user_data;
  qos.owner = owner;
  return qos;
}

}  // namespace quoin::ros2
