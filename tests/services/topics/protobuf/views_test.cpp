// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/topics/protobuf/views.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <foxglove/foxglove.pb.h>
#include <idl/Corners.h>
#include <idl/Lines.h>
#include <idl/Scan.h>
#include <idl/Status.h>
#include <limits>
#include <string>

#include <gtest/gtest.h>

#include "services/topics/cdr_codec.hpp"
#include "services/topics/protobuf/schemas.hpp"
#include "services/topics/topic_types.hpp"

namespace quoin::topics {
namespace {

/// The view of that name of a message; nothing when it has none.
template <class Shown, class T>
std::optional<Shown> shown(const char* type, const char* view, const T& message) {
  RawMessage raw;
  encode(message, raw);
  Views views(type);
  EXPECT_TRUE(views.read(raw.cdr));
  const auto list = views.list();
  const auto found = std::ranges::find(list, view, &View::name);
  EXPECT_NE(found, list.end());
  EXPECT_EQ(found->schema, Shown::descriptor()->full_name());
  std::string bytes;
  if (!views.append(static_cast<std::size_t>(found - list.begin()), bytes)) return std::nullopt;
  Shown result;
  EXPECT_TRUE(result.ParseFromString(bytes));
  return result;
}

msg::Scan scan_of(std::initializer_list<float> bearings, std::initializer_list<float> ranges) {
  msg::Scan scan;
  scan.header().stamp(1'500'000'000'250'000'000);
  scan.header().frame("laser");
  scan.bearings(bearings);
  scan.ranges(ranges);
  return scan;
}

TEST(Views, SchemasAreDeclared) {
  for (const TopicType& type : topic_types()) {
    const Views views(type.name);
    for (const View& view : views.list()) {
      EXPECT_NO_THROW((void)protobuf_message(view.schema)) << type.name << ' ' << view.name;
    }
  }
  EXPECT_NO_THROW((void)protobuf_message(frame_transform_schema));
}

TEST(Views, HeartbeatsThatSayMoreThanAllIsWellAreLogged) {
  msg::ServiceStatus status;
  status.service("walls");
  status.stamp(1'500'000'000'250'000'000);
  status.state(msg::ServiceState::STATE_ACTIVE);
  EXPECT_FALSE(shown<foxglove::Log>("status", "log", status));
  status.detail("2 lines skipped");
  auto log = shown<foxglove::Log>("status", "log", status);
  ASSERT_TRUE(log);
  EXPECT_EQ(log->level(), foxglove::Log::WARNING);
  EXPECT_EQ(log->message(), "2 lines skipped");
  EXPECT_EQ(log->name(), "walls");
  EXPECT_EQ(log->timestamp().nanos(), 250'000'000);
  status.state(msg::ServiceState::STATE_FAILED);
  log = shown<foxglove::Log>("status", "log", status);
  ASSERT_TRUE(log);
  EXPECT_EQ(log->level(), foxglove::Log::ERROR);
  EXPECT_EQ(log->message(), "failed: 2 lines skipped");
}

TEST(Views, AnEvenScanIsShownAsRays) {
  const auto rays = shown<foxglove::LaserScan>("scan", "laser_scan",
                                               scan_of({-1.0F, 0.0F, 1.0F}, {1.0F, 2.0F, 3.0F}));
  ASSERT_TRUE(rays);
  EXPECT_EQ(rays->timestamp().seconds(), 1'500'000'000);
  EXPECT_EQ(rays->timestamp().nanos(), 250'000'000);
  EXPECT_EQ(rays->frame_id(), "laser");
  EXPECT_EQ(rays->start_angle(), -1.0);
  EXPECT_EQ(rays->end_angle(), 1.0);
  ASSERT_EQ(rays->ranges_size(), 3);
  EXPECT_EQ(rays->ranges(2), 3.0);
}

TEST(Views, AnUnevenScanIsShownByItsPointsAlone) {
  const msg::Scan scan =
      scan_of({0.0F, 0.5F, 1.5708F}, {2.0F, std::numeric_limits<float>::infinity(), 3.0F});
  EXPECT_FALSE(shown<foxglove::LaserScan>("scan", "laser_scan", scan));
  const auto cloud = shown<foxglove::PointCloud>("scan", "points", scan);
  ASSERT_TRUE(cloud);
  ASSERT_EQ(cloud->point_stride(), 12U);
  ASSERT_EQ(cloud->data().size(), 24U);  // no return is no point
  float points[6];
  std::memcpy(points, cloud->data().data(), sizeof points);
  EXPECT_NEAR(points[0], 2.0F, 1e-6F);
  EXPECT_NEAR(points[4], 3.0F, 1e-6F);
}

TEST(Views, ALineIsAStrokeFromEndToEnd) {
  msg::Lines lines;
  lines.lines().resize(2);
  lines.lines()[1].start().x(1.0);
  lines.lines()[1].end().y(2.0);
  const auto scene = shown<foxglove::SceneUpdate>("lines", "scene", lines);
  ASSERT_TRUE(scene);
  ASSERT_EQ(scene->entities_size(), 2);
  ASSERT_EQ(scene->deletions_size(), 1);
  const foxglove::LinePrimitive& stroke = scene->entities(1).lines(0);
  ASSERT_EQ(stroke.points_size(), 2);
  EXPECT_EQ(stroke.points(0).x(), 1.0);
  EXPECT_EQ(stroke.points(1).y(), 2.0);
}

TEST(Views, ACornerHasItsEllipse) {
  msg::Corners corners;
  corners.corners().resize(1);
  corners.corners()[0].x(1.0);
  corners.corners()[0].ellipse95_major(0.2);
  corners.corners()[0].ellipse95_minor(0.1);
  corners.corners()[0].ellipse95_direction(std::acos(0.0));  // the long axis along y
  const auto scene = shown<foxglove::SceneUpdate>("corners", "scene", corners);
  ASSERT_TRUE(scene);
  ASSERT_EQ(scene->entities_size(), 1);
  double widest = 0.0;
  double highest = 0.0;
  for (const foxglove::Point3& point : scene->entities(0).lines(1).points()) {
    widest = std::max(widest, std::abs(point.x() - 1.0));
    highest = std::max(highest, std::abs(point.y()));
  }
  EXPECT_NEAR(widest, 0.1, 1e-9);
  EXPECT_NEAR(highest, 0.2, 1e-9);
}

TEST(Views, WhatIsNoMessageIsNotShown) {
  const std::byte few[] = {std::byte{0}, std::byte{1}, std::byte{0}, std::byte{0}};
  EXPECT_FALSE(Views("lines").read(few));
  EXPECT_TRUE(Views("unknown").list().empty());
}

TEST(FrameTransform, TurnsAboutZ) {
  foxglove::FrameTransform transform;
  ASSERT_TRUE(
      transform.ParseFromString(frame_transform("map", "laser", -1, {1.0, 2.0, std::acos(-1.0)})));
  EXPECT_EQ(transform.parent_frame_id(), "map");
  EXPECT_EQ(transform.timestamp().seconds(), -1);
  EXPECT_EQ(transform.timestamp().nanos(), 999'999'999);
  EXPECT_EQ(transform.translation().y(), 2.0);
  EXPECT_NEAR(transform.rotation().z(), 1.0, 1e-12);
  EXPECT_NEAR(transform.rotation().w(), 0.0, 1e-12);
}

}  // namespace
}  // namespace quoin::topics
