// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/localization/localizer_method.hpp"

#include <optional>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "services/localization/map_keeper.hpp"
#include "services/maps/map_file.hpp"
#include "services/topics/line_map.hpp"
#include "tests/sensor_bridge/error_of.hpp"
#include "tests/services/localization/room_drive.hpp"
#include "tests/temporary_folder.hpp"

namespace quoin {
namespace {

using quoin::tests::error_of;
using quoin::tests::TemporaryFolder;
using testing::HasSubstr;

void expect_at(const msg::Pose& pose, double x, double y, double theta, double tolerance = 1e-3) {
  EXPECT_NEAR(pose.pose().x(), x, tolerance);
  EXPECT_NEAR(pose.pose().y(), y, tolerance);
  EXPECT_NEAR(pose.pose().theta(), theta, tolerance);
}

TEST(Mapping, GivesThePoseOfTheRobotAndAMapInItsFrame) {
  RoomDrive drive(make_mapper, "line_merge",
                  {{"start_x", "5"},
                   {"start_yaw", "90 deg"},
                   {"mounting_x", "0.3"},
                   {"map_frame", "hall"},
                   {"base_frame", "robot"}});
  // The robot turns where it stands; its sensor in front of it moves on a circle.
  const Pose2 mounting{0.3, 0.0, 0.0};
  for (int i = 0; i <= 5; ++i) {
    const Pose2 robot{-0.3, 0.0, 0.1 * i};
    drive.drive(100 * i, {7.0, 1.0, 2.0 + robot.theta});
    const msg::Pose& pose = drive.scan(100 * i, compose(robot, mounting));
    expect_at(pose, 5.0, 0.0, 0.5 * 3.14159265358979 + 0.1 * i);
    EXPECT_EQ(pose.header().frame(), "hall");
    EXPECT_EQ(pose.child_frame(), "robot");
    EXPECT_EQ(pose.odometry(), i > 0);
    EXPECT_EQ(pose.lines(), 8U);
  }
  ASSERT_FALSE(drive.map_->written.empty());
  topics::ReceivedLineMap map;
  for (const msg::LineMap& part : drive.map_->written) {
    EXPECT_EQ(part.header().frame(), "hall");
    EXPECT_TRUE(map.take(part));
  }
  ASSERT_TRUE(map.complete());
  ASSERT_EQ(map.lines().size(), 8U);
  // The wall from (-2, -1.5) to (4, -1.5), as seen from a robot at (-0.3, 0) that is at (5, 0) and
  // looks along y there.
  EXPECT_NEAR(map.lines()[0].start.x(), 5.0 + 1.5, 1e-6);
  EXPECT_NEAR(map.lines()[0].start.y(), -2.0 + 0.3, 1e-6);
  EXPECT_NEAR(map.lines()[0].end.y(), 4.0 + 0.3, 1e-6);
}

TEST(Mapping, InterpolatesOdometryAtTheStampsOfScans) {
  RoomDrive drive(make_mapper, "line_merge", {});
  for (int i = 0; i <= 10; ++i) drive.drive(70 * i, {0.07 * i, 0.0, 0.0});
  drive.scan(35, {0.0, 0.0, 0.0});
  expect_at(drive.scan(500, {0.465, 0.0, 0.0}), 0.465, 0.0, 0.0);
}

TEST(Mapping, WorksWithTheLidarAlone) {
  RoomDrive drive(make_mapper, "landmarks", {});
  for (int i = 0; i <= 20; ++i) {
    const msg::Pose& pose = drive.scan(100 * i, {0.05 * i, 0.0, 0.02 * i});
    EXPECT_FALSE(pose.odometry());
    EXPECT_EQ(pose.status(), msg::PoseStatus::POSE_TRACKING) << i;
    expect_at(pose, 0.05 * i, 0.0, 0.02 * i, 0.02);
  }
}

TEST(Mapping, DoesWithoutOdometryThatIsWrong) {
  RoomDrive drive(make_mapper, "landmarks", {{"largest_speed", "2 m/s"}});
  drive.drive(0, {});
  drive.scan(0, {});
  drive.drive(100, {0.05, 0.0, 0.0});
  EXPECT_TRUE(drive.scan(100, {0.05, 0.0, 0.0}).odometry());
  drive.drive(200, {3.0, 0.0, 0.0});
  EXPECT_FALSE(drive.scan(200, {0.1, 0.0, 0.0}).odometry()) << "it jumps";
  drive.drive(300, {3.05, 0.0, 0.0});
  EXPECT_TRUE(drive.scan(300, {0.15, 0.0, 0.0}).odometry()) << "and goes on from there";
  EXPECT_FALSE(drive.scan(400, {0.2, 0.0, 0.0}).odometry()) << "it has stopped";
  const msg::Pose& pose = drive.scan(500, {0.25, 0.0, 0.0});
  EXPECT_FALSE(pose.odometry());
  expect_at(pose, 0.25, 0.0, 0.0, 0.02);
  EXPECT_EQ(drive.stage_.status().inputs()[1].unjoined(), 2U);
  EXPECT_THAT(drive.stage_.status().detail(), HasSubstr("nothing comes by port odometry"));
}

TEST(Mapping, GoesOnWhereStampsGoBack) {
  RoomDrive drive(make_mapper, "landmarks", {});
  for (int i = 0; i <= 5; ++i) drive.scan(1000 + 100 * i, {0.05 * i, 0.0, 0.0});
  const msg::Pose& pose = drive.scan(0, {0.3, 0.0, 0.0});
  expect_at(pose, 0.3, 0.0, 0.0, 0.05);
  drive.scan(100, {0.35, 0.0, 0.0});
  EXPECT_TRUE(drive.stage_.losses().empty());
  EXPECT_THAT(drive.diagnostic("Stamps"), HasSubstr("went back 1 times"));
}

TEST(Mapping, SaysWhatItHas) {
  RoomDrive drive(make_mapper, "line_merge", {});
  drive.scan(0, {});
  EXPECT_EQ(drive.diagnostic("Map"), "8 walls, 21 m");
  EXPECT_THAT(drive.diagnostic("Pose"), HasSubstr("of 8 lines in the map"));
}

class MapsOnDisk : public testing::Test {
 protected:
  std::optional<RoomDrive>& start(const std::string& method = "line_merge") {
    drive_.emplace(make_mapper, method, ParameterSettings{{"map", "room.qmap"}}, folder_.path());
    return drive_;
  }
  std::string refusal(const std::string& method) {
    return error_of<ParameterError>([&] {
      (void)make_mapper(method, {{"map", "room.qmap"}}, folder_.path());
    });
  }

  TemporaryFolder folder_;
  std::filesystem::path file_ = folder_.path() / "room.qmap";
  std::optional<RoomDrive> drive_;
};

TEST_F(MapsOnDisk, SurviveARestart) {
  start();
  for (int i = 0; i <= 5; ++i) {
    drive_->drive(100 * i, {0.1 * i, 0.0, 0.0});
    drive_->scan(100 * i, {0.1 * i, 0.0, 0.0});
  }
  EXPECT_THAT(drive_->diagnostic("Map File"), HasSubstr("room.qmap: not saved yet"));
  drive_.reset();
  const maps::SavedMap saved = maps::parse_map(maps::read_text(file_), "room.qmap");
  EXPECT_EQ(saved.lines.size(), 8U);
  EXPECT_EQ(saved.method, "line_merge");

  start();
  drive_->drive(0, {0.0, 0.0, 0.0});
  expect_at(drive_->scan(0, {0.5, 0.0, 0.0}), 0.5, 0.0, 0.0);
  topics::ReceivedLineMap map;
  for (const msg::LineMap& part : drive_->map_->written) EXPECT_TRUE(map.take(part));
  EXPECT_EQ(map.lines().size(), 8U) << "the same walls";
}

TEST_F(MapsOnDisk, ThatAreDamagedAreRefusedAndLeftAlone) {
  start();
  drive_->scan(0, {});
  drive_.reset();
  std::string text = maps::read_text(file_);
  text[text.size() / 2] ^= 1;
  maps::write_whole(file_, text);
  EXPECT_THAT(refusal("line_merge"), HasSubstr("room.qmap"));
  EXPECT_EQ(maps::read_text(file_), text);
}

TEST_F(MapsOnDisk, OfAnotherMethodAreRefusedByName) {
  start();
  drive_->scan(0, {});
  drive_.reset();
  EXPECT_THAT(refusal("landmarks"), HasSubstr("holds a map of method line_merge"));
}

TEST_F(MapsOnDisk, HaveOneWriter) {
  start();
  drive_->scan(0, {});
  RoomDrive other(make_mapper, "line_merge", {{"map", "room.qmap"}}, folder_.path());
  MapKeeper keeper(file_);
  keeper.save({});
  keeper.wait();
  EXPECT_THAT(keeper.status(), HasSubstr("saved"));
  MapKeeper second(file_);
  second.save({});
  EXPECT_THAT(second.status(), HasSubstr("another process keeps its map in this file"));
}

TEST_F(MapsOnDisk, ThatCannotBeWrittenAreSaidToBe) {
  MapKeeper keeper(folder_.path() / "none" / "room.qmap");
  keeper.save({});
  keeper.wait();
  EXPECT_THAT(keeper.status(), HasSubstr("room.qmap: not saved: "));
}

TEST(Mapping, HandsItsStateOver) {
  const runtime::Method first = make_mapper("landmarks", {}, "/nowhere");
  RoomDrive drive(make_mapper, "landmarks", {});
  for (int i = 0; i <= 10; ++i) drive.scan(100 * i, {0.1 * i, 0.0, 0.0});
  const auto state = drive.stage_.node().exchange().save();
  EXPECT_FALSE(state.empty());
  EXPECT_NO_THROW(first.restore(state));
  EXPECT_EQ(first.save(), state);
  EXPECT_THROW(first.restore({1, 2, 3}), std::invalid_argument);
  EXPECT_EQ(first.save(), state) << "as it was";
}

TEST(Localization, FollowsTheRobotInAPlan) {
  const TemporaryFolder folder;
  folder.write("room.svg", R"(<svg><polygon points="-200,150 400,150 400,-200 100,-200 100,-120
                               40,-120 40,-200 -200,-200"/></svg>)");
  RoomDrive drive(make_localizer, "landmarks",
                  {{"map", "room.svg"},
                   {"map_scale", "1 cm"},
                   {"start_known", "true"},
                   {"start_x", "1.1"},
                   {"start_y", "0.4"},
                   {"start_yaw", "0.25"}},
                  folder.path());
  for (int i = 0; i <= 20; ++i) drive.scan(100 * i, {1.0 + 0.05 * i, 0.5, 0.3});
  const msg::Pose& last = drive.poses_->written.back();
  EXPECT_EQ(last.status(), msg::PoseStatus::POSE_TRACKING);
  expect_at(last, 2.0, 0.5, 0.3, 0.05);
  topics::ReceivedLineMap map;
  for (const msg::LineMap& part : drive.map_->written) EXPECT_TRUE(map.take(part));
  EXPECT_EQ(map.lines().size(), 8U) << "the plan as it is";
}

TEST(Localization, NeedsAMap) {
  const TemporaryFolder folder;
  const auto refusal = [&](const std::string& map) {
    return error_of<ParameterError>([&] {
      (void)make_localizer("landmarks", {{"map", map}}, folder.path());
    });
  };
  EXPECT_THAT(refusal("none.svg"), HasSubstr("none.svg: cannot be read"));
  folder.write("empty.svg", "<svg></svg>");
  EXPECT_THAT(refusal("empty.svg"), HasSubstr("no lines in it"));
}

}  // namespace
}  // namespace quoin
