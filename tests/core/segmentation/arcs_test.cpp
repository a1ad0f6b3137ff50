// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/segmentation/arcs.hpp"

#include <cmath>

#include <gmock/gmock.h>

#include "tests/core/segmentation/segmenter_scans.hpp"

namespace quoin {
namespace {

using testing::IsEmpty;
using testing::SizeIs;

/// A room, its far wall `behind` metres behind a pole of this radius at (distance, 0.3).
World room_with_pole(double radius, double distance, double behind) {
  World world;
  const double far = distance + radius + behind;
  world.add_polyline({{far, -3.0}, {far, 3.0}, {-2.0, 3.0}, {-2.0, -3.0}}, true);
  world.pillars.push_back({{distance, 0.3}, radius});
  world.path = {{0.0, 0.0, 0.0}};
  return world;
}

struct Found {
  Points points;
  Segmentation segmentation;
};

Found found_in(const World& world, const SensorModel& noise, std::uint64_t seed) {
  Found found{scan_of(world, noise, seed).points, {}};
  Segmenters::make<Segmenter>("iepf", {})(found.points, noise, found.segmentation);
  set_aside(found.points, found.segmentation);
  return found;
}

TEST(ThinThings, APoleInFrontOfAWallIsAnArcAndTheWallGoesOn) {
  const SensorModel noise{0.003, 0.0005};
  for (const double radius : {0.05, 0.06}) {
    for (const double behind : {0.3, 1.5}) {
      for (std::uint64_t seed = 1; seed <= 5; ++seed) {
        const World world = room_with_pole(radius, 1.0, behind);
        const Found found = found_in(world, noise, seed);
        EXPECT_THAT(found.segmentation.segments, SizeIs(4));
        ASSERT_THAT(found.segmentation.arcs, SizeIs(1)) << radius << ' ' << behind << ' ' << seed;
        const Segment arc = found.segmentation.arcs.front();
        EXPECT_GE(arc.begin, found.points.size() - found.segmentation.foreign.size());
        for (std::size_t i = arc.begin; i < arc.end; ++i) {
          const double off = std::hypot(found.points.x[i] - 1.0, found.points.y[i] - 0.3) - radius;
          EXPECT_LT(std::abs(off), 0.02);
        }
      }
    }
  }
}

TEST(ThinThings, APoleBetweenWallsIsAnArc) {
  const SensorModel noise{0.003, 0.0005};
  World world = room_with_pole(0.08, 2.0, 0.5);
  EXPECT_THAT(found_in(world, noise, 1).segmentation.arcs, SizeIs(1));
  // Nothing behind it.
  world.walls.erase(world.walls.begin());
  EXPECT_THAT(found_in(world, noise, 1).segmentation.arcs, SizeIs(1));
}

TEST(ThinThings, ANarrowBoardIsNone) {
  const SensorModel noise{0.003, 0.0005};
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    World world = room_with_pole(0.03, 1.0, 0.5);
    world.pillars.clear();
    world.walls.push_back({{1.0, 0.25}, {1.0, 0.32}});
    EXPECT_THAT(found_in(world, noise, seed).segmentation.arcs, IsEmpty()) << seed;
  }
}

// A sensor that writes one range for no return shows a circle about itself.
TEST(ThinThings, WhatBendsAroundTheSensorIsNone) {
  const SensorModel noise{0.003, 0.0005};
  Points points = scan_of(room_with_pole(0.05, 1.0, 0.5), noise, 1).points;
  Segmentation found;
  ThinThings thin_things;
  BreakpointDetector breakpoints(0.17, 0.4);
  CoarsePoints coarse;
  std::vector<Segment> clusters;
  for (double& range : points.range) range = 3.0;
  compute_cartesian(points);
  coarse.assign(points);
  (void)breakpoints.find(coarse, noise, clusters);
  thin_things.find(points, noise, Tolerance({}, noise, points), breakpoints, 0.01, found);
  EXPECT_THAT(found.arcs, IsEmpty());
}

}  // namespace
}  // namespace quoin
