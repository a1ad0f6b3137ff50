// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/ros2/poses.hpp"

#include <cmath>
#include <limits>
#include <map>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/geometry/angle.hpp"
#include "services/ros2/diagnostics.hpp"
#include "services/ros2/occupancy_grid.hpp"
#include "tests/services/ros2/estimates.hpp"

namespace quoin::ros2 {
namespace {

using tests::estimate;

constexpr std::int64_t second = 1'000'000'000;
constexpr std::int64_t now = 1'700'000'000 * second;

msg::Odometry odometry_at(std::int64_t stamp, double x, double theta = 0.0) {
  msg::Odometry made;
  made.header().stamp(stamp);
  made.header().frame("odom");
  made.child_frame("base_link");
  made.pose(estimate(x, 0.0, theta));
  return made;
}

msg::Pose pose_at(std::int64_t stamp, double x, double y, double theta) {
  msg::Pose made;
  made.header().stamp(stamp);
  made.header().frame("map");
  made.child_frame("base_link");
  made.pose(estimate(x, y, theta));
  return made;
}

double yaw(const TransformStamped& transform) {
  const auto& q = transform.transform().rotation();
  return 2.0 * std::atan2(q.z(), q.w());
}

TEST(Ros2Poses, CovariancesStandWhereRos2LooksForThem) {
  PoseWithCovarianceStamped out;
  fill_pose(pose_at(now, 1.0, 2.0, 0.5), out);
  EXPECT_EQ(out.header().frame_id(), "map");
  EXPECT_EQ(nanoseconds(out.header().stamp()), now);
  EXPECT_EQ(out.pose().pose().position().x(), 1.0);
  EXPECT_NEAR(out.pose().pose().orientation().z(), std::sin(0.25), 1e-12);
  const auto& c = out.pose().covariance();
  // Row by row of x, y, z, roll, pitch, yaw.
  const std::map<std::size_t, double> expected{{0, 0.01},    {1, 0.002},   {6, 0.002},
                                               {7, 0.03},    {5, 0.004},   {30, 0.004},
                                               {11, -0.005}, {31, -0.005}, {35, 0.06}};
  for (std::size_t i = 0; i < 36; ++i) {
    const auto found = expected.find(i);
    EXPECT_EQ(c[i], found == expected.end() ? 0.0 : found->second) << i;
  }
}

TEST(Ros2Odometry, GoesOutAndComesBackTheSame) {
  msg::Odometry in = odometry_at(now, 1.5, -2.5);
  in.velocity_known(true);
  in.velocity_x(0.4);
  in.velocity_theta(-0.2);
  Odometry wire;
  fill_odometry(in, wire);
  OdometryImport import;
  msg::Odometry out;
  ASSERT_TRUE(import.convert(wire, now, out));
  EXPECT_EQ(import.faults(), 0U);
  EXPECT_NEAR(out.pose().theta(), -2.5, 1e-12);
  out.pose().theta(in.pose().theta());
  EXPECT_EQ(out, in);
}

TEST(Ros2Odometry, VelocityThatIsNotKnownIsMarkedSo) {
  Odometry wire;
  fill_odometry(odometry_at(now, 0.0), wire);
  EXPECT_EQ(wire.twist().covariance()[0], -1.0);
  OdometryImport import;
  msg::Odometry out;
  ASSERT_TRUE(import.convert(wire, now, out));
  EXPECT_FALSE(out.velocity_known());
}

TEST(Ros2Odometry, WhatIsNoPoseIsLeftOutAndOddOnesAreNamed) {
  Odometry good;
  fill_odometry(odometry_at(now, 1.0), good);
  OdometryImport import;
  msg::Odometry out;
  Odometry bad = good;
  bad.pose().pose().orientation().w(0.0);
  EXPECT_FALSE(import.convert(bad, now, out));
  EXPECT_EQ(import.count(OdometryFault::no_rotation), 1U);
  bad = good;
  bad.pose().pose().position().x(std::numeric_limits<double>::quiet_NaN());
  EXPECT_FALSE(import.convert(bad, now, out));
  EXPECT_EQ(import.count(OdometryFault::not_finite), 1U);
  bad = good;
  bad.pose().pose().orientation().x(std::sin(0.25));
  bad.pose().pose().orientation().w(std::cos(0.25));
  EXPECT_TRUE(import.convert(bad, now, out));
  EXPECT_EQ(import.count(OdometryFault::tilted), 1U);
  EXPECT_TRUE(import.convert(good, now, out));
  EXPECT_EQ(import.count(OdometryFault::stamp_not_later), 1U);
  bad = good;
  set_header(bad.header(), 0, "");
  EXPECT_TRUE(import.convert(bad, now + second, out));
  EXPECT_EQ(import.count(OdometryFault::stamp_zero), 1U);
  EXPECT_EQ(import.count(OdometryFault::no_frames), 1U);
  EXPECT_EQ(out.header().stamp(), now + second);
}

TEST(MapToOdomTest, IsWhatTurnsTheOdometryAtTheStampIntoThePose) {
  MapToOdom drift;
  EXPECT_FALSE(drift.add(odometry_at(now, 0.0)));
  // Half way between two messages of the odometry, the second of which comes later.
  EXPECT_FALSE(drift.add(pose_at(now + second / 2, 5.0, 1.0, pi / 2)));
  const auto made = drift.add(odometry_at(now + second, 1.0));
  ASSERT_TRUE(made);
  EXPECT_EQ(made->header().frame_id(), "map");
  EXPECT_EQ(made->child_frame_id(), "odom");
  EXPECT_EQ(nanoseconds(made->header().stamp()), now + second / 2);
  EXPECT_NEAR(yaw(*made), pi / 2, 1e-9);
  // The odometry says (0.5, 0): the map's origin of it is 0.5 m behind (5, 1), looking along y.
  EXPECT_NEAR(made->transform().translation().x(), 5.0, 1e-6);
  EXPECT_NEAR(made->transform().translation().y(), 0.5, 1e-6);
}

TEST(MapToOdomTest, APoseThatIsLostOrOfAnotherFrameGivesNone) {
  MapToOdom drift;
  (void)drift.add(odometry_at(now, 0.0));
  (void)drift.add(odometry_at(now + second, 0.0));
  msg::Pose lost = pose_at(now + second / 2, 0.0, 0.0, 0.0);
  lost.status(msg::PoseStatus::POSE_LOST);
  EXPECT_FALSE(drift.add(lost));
  msg::Pose of_laser = pose_at(now + second / 2, 0.0, 0.0, 0.0);
  of_laser.child_frame("laser");
  EXPECT_FALSE(drift.add(of_laser));
  EXPECT_EQ(drift.other_frames(), 1U);
  EXPECT_TRUE(drift.add(pose_at(now + second / 2, 0.0, 0.0, 0.0)));
}

TEST(OccupancyGridTest, WallsAreOccupiedAndTheRestUnknown) {
  MapLine wall;
  wall.start = {0.0, 0.0};
  wall.end = {2.0, 0.0};
  MapLine far_off;
  far_off.start = {std::numeric_limits<double>::quiet_NaN(), 0.0};
  const std::vector<MapLine> walls{wall, far_off};
  msg::Header header;
  header.frame("map");
  OccupancyGrid out;
  fill_grid(walls, header, 0.1, out);
  EXPECT_EQ(out.header().frame_id(), "map");
  EXPECT_EQ(out.info().width(), 40U);
  EXPECT_EQ(out.info().height(), 20U);
  EXPECT_NEAR(out.info().origin().position().x(), -1.0, 1e-9);
  ASSERT_EQ(out.data().size(), 800U);
  for (std::size_t row = 0; row < 20; ++row) {
    for (std::size_t column = 0; column < 40; ++column) {
      const bool on_wall = row == 10 && column >= 10 && column <= 30;
      EXPECT_EQ(out.data()[row * 40 + column], on_wall ? 100 : 255) << row << " " << column;
    }
  }
}

TEST(OccupancyGridTest, StaysWithinItsMemory) {
  MapLine wall;
  wall.start = {-9e5, -9e5};
  wall.end = {9e5, 9e5};
  OccupancyGrid out;
  fill_grid(std::vector<MapLine>{wall}, {}, 0.05, out);
  EXPECT_LE(out.data().size(), 16'000'000U);
  EXPECT_EQ(out.data().size(), std::size_t{out.info().width()} * out.info().height());
}

TEST(Ros2Diagnostics, LevelsSayWhatTheHeartbeatSays) {
  msg::ServiceStatus status;
  status.service("walls");
  status.kind("segmentation");
  status.host("robot");
  status.state(msg::ServiceState::STATE_ACTIVE);
  DiagnosticStatus out;
  fill_diagnostic(status, second, "quoin", out);
  EXPECT_EQ(out.level(), level_ok);
  EXPECT_EQ(out.name(), "quoin/walls: segmentation");
  EXPECT_EQ(out.hardware_id(), "robot");
  fill_diagnostic(status, 10 * second, "quoin", out);
  EXPECT_EQ(out.level(), level_stale);
  status.lost(1);
  fill_diagnostic(status, second, "quoin", out);
  EXPECT_EQ(out.level(), level_warn);
  status.state(msg::ServiceState::STATE_STOPPED);
  fill_diagnostic(status, 10 * second, "quoin", out);
  EXPECT_EQ(out.level(), level_ok);
  status.state(msg::ServiceState::STATE_FAILED);
  status.detail("the port is gone");
  fill_diagnostic(status, second, "quoin", out);
  EXPECT_EQ(out.level(), level_error);
  EXPECT_THAT(out.message(), testing::HasSubstr("the port is gone"));
}

}  // namespace
}  // namespace quoin::ros2
