// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/ros2/topics.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "services/ros2/messages.hpp"

namespace quoin::ros2 {
namespace {

TEST(Ros2Topics, NamesAreThoseOfRos2OnDds) {
  EXPECT_EQ(topics::type_name<LaserScan>(), "sensor_msgs::msg::dds_::LaserScan_");
  EXPECT_EQ(dds_type_name("sensor_msgs/msg/LaserScan"), "sensor_msgs::msg::dds_::LaserScan_");
  EXPECT_EQ(ros_type_name("sensor_msgs::msg::dds_::LaserScan_"), "sensor_msgs/msg/LaserScan");
  EXPECT_EQ(ros_type_name("quoin::msg::Scan"), "");
  EXPECT_EQ(dds_topic("/scan"), "rt/scan");
  EXPECT_EQ(dds_topic("robot_1/front/scan"), "rt/robot_1/front/scan");
}

TEST(Ros2Topics, WhatIsNoNameIsRefused) {
  for (const char* name :
       {"", "/", "scan/", "//scan", "1scan", "/a/2", "a b", "scan;x", "~/scan"}) {
    EXPECT_THROW((void)dds_topic(name), std::invalid_argument) << name;
  }
}

TEST(Ros2Topics, EndpointsAnnounceTheHashOfTheirType) {
  const TopicType& type = topic_type<LaserScan>();
  const std::string announced = "typehash=RIHS01_" + std::string(type.hash) + ";";
  EXPECT_EQ(writer_qos(type).user_data, announced);
  EXPECT_EQ(reader_qos(type, false).user_data, announced);
  EXPECT_EQ(type.hash.size(), 64U);
}

TEST(Ros2Topics, ReadersOfAnyQosAreServed) {
  EXPECT_EQ(writer_qos(topic_type<LaserScan>()).preset, runtime::QosPreset::sensor);
  EXPECT_EQ(reader_qos(topic_type<LaserScan>(), false).preset, runtime::QosPreset::best_effort);
  EXPECT_EQ(writer_qos(topic_type<OccupancyGrid>()).preset, runtime::QosPreset::state);
}

}  // namespace
}  // namespace quoin::ros2
