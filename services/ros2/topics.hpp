// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "services/deployment/deployment.hpp"
#include "services/runtime/dds/qos.hpp"
#include "services/topics/cdr_codec.hpp"

namespace quoin::ros2 {

/// A message type as ROS 2 knows it.
struct TopicType {
  std::string_view name;  ///< "sensor_msgs/msg/LaserScan"
  /// Of its definition (REP-2011), RIHS01 without the prefix: those who read it compare.
  std::string_view hash;
  runtime::QosPreset qos;  ///< of our writers, by REP-2003
  int depth;
};

/// All that services of ROS 2 kinds read or write.
[[nodiscard]] std::span<const TopicType> topic_types();

/// Throws std::out_of_range when there is no such row. `name` as ROS 2 has it.
[[nodiscard]] const TopicType& topic_type(std::string_view name);

/// The row of one of our own types, named as in our table: "lines". Likewise.
[[nodiscard]] const TopicType& own_type(std::string_view type);

/// "sensor_msgs::msg::dds_::LaserScan_" of "sensor_msgs/msg/LaserScan".
[[nodiscard]] std::string dds_type_name(std::string_view name);
/// And back.
[[nodiscard]] std::string ros_type_name(std::string_view dds_type);

/// Row of a generated type.
template <class T>
[[nodiscard]] const TopicType& topic_type() {
  return topic_type(ros_type_name(topics::type_name<T>()));
}

/// What DDS calls a topic of ROS 2: "rt/scan" of "/scan" or "scan". Throws std::invalid_argument
/// for what is no name of a topic.
[[nodiscard]] std::string dds_topic(std::string_view name);

/// Throws ParameterError when the value of that parameter is no name of a ROS 2 topic, and
/// std::invalid_argument when the deployment has security, which ROS 2 has no keys for.
void check_topic(const Deployment& deployment, const std::string& parameter,
                 const std::string& topic);

/// Of a writer of that type, with the hash that others look for. `owner`: label of the service that
/// is its node, see runtime::TopicQos.
[[nodiscard]] runtime::TopicQos writer_qos(const TopicType& type, const std::string& owner = "");

/// Of a reader. Best effort gets messages of every writer, reliable those that are sent reliably,
/// without a loss.
[[nodiscard]] runtime::TopicQos reader_qos(const TopicType& type, bool reliable,
                                           const std::string& owner = "");

}  // namespace quoin::ros2
