// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/segmentation/iepf.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

#include <gmock/gmock.h>

#include "core/sensor/scan.hpp"
#include "core/simulation/scanner.hpp"
#include "tests/core/wall_points.hpp"

namespace quoin {
namespace {

SimulatedScan noisy_scan(const char* world, std::uint64_t seed) {
  SimulatedScanner scanner(built_in_world(world).value(), {}, seed);
  SimulatedScan scan;
  scanner.scan(0.0, 0.0, scan);
  return scan;
}

using PointSet = std::set<std::pair<double, double>>;

/// Each segment as the set of its points, whatever the order of the scan.
std::set<PointSet> segments_of(const SimulatedScan& scan, const Iepf::Parameters& parameters = {}) {
  Points points;
  convert({scan.bearings, scan.ranges, 0.1F, 40.0F}, points);
  Iepf iepf(parameters);
  Segmentation found{.segments = {{7, 9}}, .arcs = {}, .foreign = {}};
  iepf(points, SensorModel{}, found);
  std::set<PointSet> sets;
  std::size_t free_from = 0;
  for (const Segment& segment : found.segments) {
    EXPECT_GE(segment.begin, free_from);
    EXPECT_LE(segment.end, points.size());
    EXPECT_GE(segment.size(), static_cast<std::size_t>(parameters.min_points));
    free_from = segment.end;
    PointSet set;
    for (std::size_t i = segment.begin; i < segment.end; ++i)
      set.emplace(points.bearing[i], points.range[i]);
    sets.insert(set);
  }
  return sets;
}

TEST(Iepf, DoesNotDependOnWhereTheScanStarts) {
  for (const char* world : {"square_room", "domestic_room", "environment_b"}) {
    SimulatedScan scan = noisy_scan(world, 11);
    const auto expected = segments_of(scan);
    EXPECT_GE(expected.size(), 4U);
    for (int turn = 0; turn < 12; ++turn) {
      std::rotate(scan.bearings.begin(), scan.bearings.begin() + 77, scan.bearings.end());
      std::rotate(scan.ranges.begin(), scan.ranges.begin() + 77, scan.ranges.end());
      EXPECT_EQ(segments_of(scan), expected) << world << turn;
    }
    std::reverse(scan.bearings.begin(), scan.bearings.end());
    std::reverse(scan.ranges.begin(), scan.ranges.end());
    EXPECT_EQ(segments_of(scan), expected) << world << " clockwise";
  }
}

TEST(Iepf, SplitsARoomIntoItsFourWalls) {
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    const auto segments = segments_of(noisy_scan("square_room", seed));
    std::size_t long_ones = 0;
    for (const PointSet& set : segments) long_ones += set.size() > 200 ? 1 : 0;
    EXPECT_EQ(long_ones, 4U) << seed;
    EXPECT_LE(segments.size(), 5U) << seed;
  }
}

TEST(Iepf, SurvivesInvalidPointsAndGaps) {
  SimulatedScan scan = noisy_scan("square_room", 3);
  for (std::size_t i = 0; i < scan.ranges.size(); i += 5) {
    scan.ranges[i] = i % 2 == 0 ? std::numeric_limits<float>::quiet_NaN() : 0.0F;
  }
  for (std::size_t i = 100; i < 140; ++i) scan.ranges[i] = std::numeric_limits<float>::infinity();
  const auto segments = segments_of(scan);
  EXPECT_GE(segments.size(), 4U);
  EXPECT_LE(segments.size(), 7U);
}

TEST(Iepf, BreaksAtGapsOfTheBreakpointAngle) {
  const Line wall{0.0, 2.0};
  Points left = exact_wall_points(wall, -0.5, -0.1, 60);
  const Points right = exact_wall_points(wall, 0.1, 0.5, 60);  // 0.2 rad = 11.5 deg away
  for (auto member : {&Points::range, &Points::bearing, &Points::inverse_range, &Points::cosine,
                      &Points::sine, &Points::x, &Points::y}) {
    (left.*member).insert((left.*member).end(), (right.*member).begin(), (right.*member).end());
  }
  Segmentation found;
  Iepf()(left, SensorModel{}, found);
  EXPECT_EQ(found.segments, (std::vector<Segment>{{1, 59}, {61, 119}}));
  Iepf::Parameters wide;
  wide.breakpoint_angle = 0.3;
  wide.max_line_gap = 0.5;
  Iepf{wide}(left, SensorModel{}, found);
  EXPECT_EQ(found.segments, (std::vector<Segment>{{1, 119}}));
}

TEST(Iepf, TakesAnyNumberOfPoints) {
  Segmentation found{.segments = {{1, 2}}, .arcs = {}, .foreign = {}};
  for (const bool refine : {false, true}) {
    Iepf::Parameters parameters;
    parameters.min_points = 2;
    parameters.min_length = 0.0;
    parameters.refine = refine;
    Iepf iepf(parameters);
    iepf(Points{}, SensorModel{}, found);
    EXPECT_TRUE(found.segments.empty());
    iepf(points_from({0.1}, {1.0}), SensorModel{}, found);
    EXPECT_TRUE(found.segments.empty());
    iepf(points_from({0.1, 0.1}, {1.0, 1.0}), SensorModel{}, found);
    EXPECT_TRUE(found.segments.empty());
    iepf(points_from(std::vector<double>(50, 0.1), std::vector<double>(50, 1.0)), SensorModel{},
         found);
    EXPECT_TRUE(found.segments.empty());
  }
}

TEST(Iepf, DropsShortSegments) {
  const Points points = exact_wall_points({0.0, 1.0}, -0.04, 0.04, 20);  // 8 cm
  Segmentation found;
  Iepf()(points, SensorModel{}, found);
  EXPECT_TRUE(found.segments.empty());
}

TEST(Iepf, HasDeepSplitsWithoutRecursion) {
  // A saw of 2000 teeth.
  std::vector<double> bearings;
  std::vector<double> ranges;
  for (int i = 0; i < 4000; ++i) {
    bearings.push_back(i * 0.0015);
    ranges.push_back(i % 2 == 0 ? 2.0 : 2.3);
  }
  Segmentation found;
  Iepf::Parameters parameters;
  parameters.breakpoint_angle = 0.01;
  parameters.noise_factor = 0.0;
  parameters.flatness = 0.001;
  Iepf{parameters}(points_from(bearings, ranges), SensorModel{0.1, 0.0, 0.0}, found);
  EXPECT_TRUE(found.segments.empty());
}

}  // namespace
}  // namespace quoin
