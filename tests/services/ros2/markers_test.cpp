// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/ros2/markers.hpp"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace quoin::ros2 {
namespace {

constexpr std::int32_t deleted = 2;
const MarkerStyle style{.ns = "corners", .lifetime = 1.5};

msg::Corners with_corners(std::size_t count) {
  msg::Corners message;
  message.header().stamp(12'000'000'034);
  message.header().frame("laser");
  for (std::size_t i = 0; i < count; ++i) {
    msg::Corner corner;
    corner.x(1.0 + static_cast<double>(i));
    corner.y(2.0);
    corner.ellipse95_major(0.2);
    corner.ellipse95_minor(0.1);
    corner.ellipse95_direction(0.7);
    message.corners().push_back(corner);
  }
  return message;
}

TEST(Markers, OfCornersAreTheirPlacesAndEllipses) {
  MarkerArray out;
  fill_markers(with_corners(2), style, out);
  ASSERT_EQ(out.markers().size(), 2U);
  const Marker& places = out.markers()[0];
  ASSERT_EQ(places.points().size(), 2U);
  EXPECT_EQ(places.points()[1].x(), 2.0);
  EXPECT_EQ(places.header().frame_id(), "laser");
  EXPECT_EQ(places.header().stamp().sec(), 12);
  EXPECT_EQ(places.header().stamp().nanosec(), 34U);
  EXPECT_EQ(places.ns(), "corners");
  EXPECT_EQ(places.lifetime().sec(), 1);
  EXPECT_EQ(places.lifetime().nanosec(), 500'000'000U);
  const Marker& ellipses = out.markers()[1];
  ASSERT_EQ(ellipses.points().size(), 2U * 2U * 24U);
  for (std::size_t i = 0; i < 48; ++i) {
    // In the axes of the ellipse it is on it.
    const double x = ellipses.points()[i].x() - 1.0;
    const double y = ellipses.points()[i].y() - 2.0;
    const double u = (std::cos(0.7) * x + std::sin(0.7) * y) / 0.2;
    const double v = (-std::sin(0.7) * x + std::cos(0.7) * y) / 0.1;
    EXPECT_NEAR(u * u + v * v, 1.0, 1e-9);
  }
}

TEST(Markers, KeepTheirIdsAndTakeThePlaceOfThoseBefore) {
  MarkerArray out;
  fill_markers(with_corners(5), style, out);
  const auto ids = [&] {
    std::vector<std::int32_t> all;
    for (const Marker& marker : out.markers()) all.push_back(marker.id());
    return all;
  };
  const auto before = ids();
  fill_markers(with_corners(1), style, out);
  EXPECT_EQ(ids(), before);
  EXPECT_EQ(out.markers()[0].points().size(), 1U);
  // Viewers refuse markers without points.
  fill_markers(with_corners(0), style, out);
  EXPECT_EQ(ids(), before);
  for (const Marker& marker : out.markers()) EXPECT_EQ(marker.action(), deleted);
}

TEST(Markers, OfSegmentsAreAllPointsWithAColorEach) {
  msg::Segments in;
  in.bearings({0.0F, 0.1F, 0.2F, 0.3F});
  in.ranges({1.0F, 2.0F, 3.0F, 4.0F});
  in.segments().resize(2);
  in.segments()[0].begin(0);
  in.segments()[0].end(2);
  in.segments()[1].begin(3);
  in.segments()[1].end(4);
  MarkerArray out;
  fill_markers(in, style, out);
  const Marker& marker = out.markers().front();
  ASSERT_EQ(marker.points().size(), 4U);
  ASSERT_EQ(marker.colors().size(), 4U);
  EXPECT_NEAR(marker.points()[1].x(), 2.0 * std::cos(0.1), 1e-6);
  EXPECT_EQ(marker.colors()[0], marker.colors()[1]);
  EXPECT_NE(marker.colors()[0], marker.colors()[2]);
  EXPECT_NE(marker.colors()[0], marker.colors()[3]);
  // Anybody may have sent one whose ranges lead outside.
  in.segments()[1].end(9);
  fill_markers(in, style, out);
  EXPECT_TRUE(out.markers().front().points().empty());
}

TEST(Markers, OfCirclesLieOnThem) {
  msg::Circles in;
  msg::Circle circle;
  circle.x(1.0);
  circle.y(-2.0);
  circle.radius(0.3);
  circle.arc_start(3.0);
  circle.arc_end(4.0);
  in.circles().push_back(circle);
  MarkerArray out;
  fill_markers(in, style, out);
  ASSERT_EQ(out.markers().size(), 2U);
  for (const Marker& marker : out.markers()) {
    ASSERT_FALSE(marker.points().empty());
    for (const auto& point : marker.points()) {
      EXPECT_NEAR(std::hypot(point.x() - 1.0, point.y() + 2.0), 0.3, 1e-9);
    }
  }
  EXPECT_NEAR(out.markers()[1].points().front().x(), 1.0 + 0.3 * std::cos(3.0), 1e-9);
  EXPECT_NEAR(out.markers()[1].points().back().x(), 1.0 + 0.3 * std::cos(4.0), 1e-9);
}

}  // namespace
}  // namespace quoin::ros2
