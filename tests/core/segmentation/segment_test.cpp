// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/segmentation/segment.hpp"

#include <gmock/gmock.h>

#include "tests/core/wall_points.hpp"

namespace quoin {
namespace {

using testing::ElementsAre;

TEST(SetAside, MovesForeignPointsBehindAllOthersInTheirOrder) {
  Points points = points_from({0.0, 0.1, 0.2, 0.3, 0.4, 0.5}, {10.0, 11.0, 12.0, 13.0, 14.0, 15.0});
  Segmentation found{.segments = {{0, 4}, {4, 6}}, .arcs = {}, .foreign = {1, 2}};
  set_aside(points, found);
  EXPECT_THAT(points.range, ElementsAre(10.0, 13.0, 14.0, 15.0, 11.0, 12.0));
  EXPECT_THAT(points.bearing, ElementsAre(0.0, 0.3, 0.4, 0.5, 0.1, 0.2));
  EXPECT_THAT(found.segments, ElementsAre(Segment{0, 2}, Segment{2, 4}));
  EXPECT_THAT(found.foreign, ElementsAre(4, 5));
}

TEST(SetAside, TakesArcsOfForeignPointsWithThem) {
  Points points = points_from({0.0, 0.1, 0.2, 0.3, 0.4, 0.5}, {10.0, 11.0, 12.0, 13.0, 14.0, 15.0});
  Segmentation found{.segments = {{0, 4}}, .arcs = {{1, 3}, {4, 6}}, .foreign = {1, 2}};
  set_aside(points, found);
  EXPECT_THAT(points.range, ElementsAre(10.0, 13.0, 14.0, 15.0, 11.0, 12.0));
  EXPECT_THAT(found.segments, ElementsAre(Segment{0, 2}));
  EXPECT_THAT(found.arcs, ElementsAre(Segment{2, 4}, Segment{4, 6}));
}

TEST(SetAside, LeavesOrderedPointsAlone) {
  Points points = points_from({0.0, 0.1}, {10.0, 11.0});
  Segmentation found{.segments = {{0, 2}}, .arcs = {}, .foreign = {}};
  set_aside(points, found);
  EXPECT_THAT(points.range, ElementsAre(10.0, 11.0));
  EXPECT_THAT(found.segments, ElementsAre(Segment{0, 2}));
}

}  // namespace
}  // namespace quoin
