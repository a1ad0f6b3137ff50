// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/ros2/definitions.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "services/ros2/topics.hpp"

namespace quoin::ros2 {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

const std::string line(80, '=');

TEST(Ros2Definitions, ATypeIsFollowedByThoseThatItIsMadeOfEachOnce) {
  EXPECT_EQ(definition("geometry_msgs/msg/Twist"),
            "geometry_msgs/Vector3 linear\ngeometry_msgs/Vector3 angular\n" + line +
                "\nMSG: geometry_msgs/Vector3\nfloat64 x\nfloat64 y\nfloat64 z\n");
  EXPECT_THAT(definition("nav_msgs/msg/OccupancyGrid"),
              AllOf(StartsWith("std_msgs/Header header\nnav_msgs/MapMetaData info\nint8[] data\n"),
                    HasSubstr("\nMSG: builtin_interfaces/Time\nint32 sec\nuint32 nanosec\n")));
}

TEST(Ros2Definitions, OwnTypesAreThoseOfThePackageWithoutItsComments) {
  EXPECT_THAT(definition("quoin_msgs/msg/Lines"),
              AllOf(StartsWith("quoin_msgs/Header header\n"), Not(HasSubstr("#")),
                    HasSubstr("\nMSG: quoin_msgs/Line\nfloat64 alpha\nfloat64 r\n")));
}

TEST(Ros2Definitions, EveryTypeThatGoesOutHasOneAndOthersHaveNone) {
  for (const TopicType& type : topic_types()) {
    const bool graph = type.name.starts_with("rmw_dds_common/");  // no topic of a user
    EXPECT_EQ(definition(type.name).empty(), graph) << type.name;
  }
  EXPECT_EQ(definition("sensor_msgs/msg/Image"), "");
  EXPECT_EQ(definition(""), "");
}

}  // namespace
}  // namespace quoin::ros2
