// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/segmentation/segment_builder.hpp"

#include <cmath>
#include <random>

#include <gmock/gmock.h>

#include "core/geometry/angle.hpp"
#include "tests/core/wall_points.hpp"

namespace quoin {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

std::vector<Segment> build(const Points& points, const std::vector<Segment>& pieces,
                           const SegmentationParameters& parameters = {},
                           const SensorModel& sensor = {}) {
  SegmentBuilder builder(parameters);
  (void)builder.start(points, sensor);
  for (const Segment& piece : pieces) builder.add(piece);
  Segmentation found;
  builder.finish(found);
  return found.segments;
}

Points noisy_wall() {
  std::mt19937_64 engine(4);
  return wall_points({0.2, 2.0}, -0.3, 0.5, 120, {}, engine);
}

TEST(SegmentBuilder, MergesWhatIsOneLine) {
  const std::vector<Segment> cut{{0, 40}, {40, 75}, {75, 120}};
  EXPECT_THAT(build(noisy_wall(), cut), ElementsAre(Segment{1, 119}));
  SegmentationParameters parameters;
  parameters.merge = false;
  parameters.refine = false;
  EXPECT_EQ(build(noisy_wall(), cut, parameters), cut);
}

TEST(SegmentBuilder, CountsPointsOfNoReturn) {
  std::mt19937_64 engine(4);
  const Points wall = wall_points({0.2, 2.0}, -0.3, 0.5, 120, {}, engine);
  std::vector<double> bearings = wall.bearing;
  std::vector<double> ranges = wall.range;
  for (int i = 0; i < 40; ++i) {
    bearings.push_back(0.6 + 0.02 * i);
    ranges.push_back(8.0);
  }
  SegmentBuilder builder{{}};
  Segmentation found;
  const Points with_fill = points_from(bearings, ranges);
  (void)builder.start(with_fill, {});
  builder.finish(found);
  EXPECT_EQ(found.no_return, 40U);
  (void)builder.start(wall, {});
  builder.finish(found);
  EXPECT_EQ(found.no_return, 0U);
}

TEST(SegmentBuilder, LeavesOutWhatNoPieceHas) {
  SegmentationParameters parameters;
  parameters.merge = false;
  EXPECT_THAT(build(noisy_wall(), {{5, 110}}, parameters), ElementsAre(Segment{6, 109}));
  // What is on its wall belongs to it.
  EXPECT_THAT(build(noisy_wall(), {{5, 110}}), ElementsAre(Segment{1, 119}));
  EXPECT_THAT(build(noisy_wall(), {}), IsEmpty());
}

TEST(SegmentBuilder, MovesTheBoundaryToTheCorner) {
  // Walls x = 2 and y = 2 that meet at 45 degrees, in steps of 0.2 degrees.
  std::vector<double> bearings;
  std::vector<double> ranges;
  for (int i = 0; i < 200; ++i) {
    const double bearing = (25.1 + 0.2 * i) * pi / 180.0;
    bearings.push_back(bearing);
    ranges.push_back(std::min(2.0 / std::cos(bearing), 2.0 / std::sin(bearing)));
  }
  const Points points = points_from(bearings, ranges);
  // The corner is between points 99 and 100; one point on either side is left out, as at the ends.
  EXPECT_THAT(build(points, {{0, 104}, {104, 200}}),
              ElementsAre(Segment{1, 99}, Segment{101, 199}));
}

/// Part of a pillar at 2 m distance.
Points arc(double radius, std::mt19937_64& engine, double noise) {
  std::normal_distribution<double> normal(0.0, noise);
  std::vector<double> bearings;
  std::vector<double> ranges;
  for (int i = 0; i < 60; ++i) {
    const double bearing = -0.05 + 0.1 / 59 * i;
    const double across = 2.0 * std::sin(bearing);
    bearings.push_back(bearing);
    ranges.push_back(2.0 * std::cos(bearing) - std::sqrt(radius * radius - across * across) +
                     normal(engine));
  }
  return points_from(bearings, ranges);
}

TEST(SegmentBuilder, RefusesPiecesOfRoundThings) {
  std::mt19937_64 engine(1);
  SegmentationParameters parameters;
  parameters.min_length = 0.1;
  int bent = 0;
  int straight = 0;
  for (int trial = 0; trial < 100; ++trial) {
    bent += build(arc(0.15, engine, 0.01), {{0, 60}}, parameters).empty() ? 1 : 0;
    const Points wall = wall_points({0.0, 2.0}, -0.06, 0.06, 60, {}, engine);
    straight += build(wall, {{0, 60}}, parameters).size() == 1 ? 1 : 0;
  }
  EXPECT_GE(bent, 95);
  EXPECT_GE(straight, 90);  // bent by chance: at most 2.4 %
}

TEST(SegmentBuilder, AcceptsShortPiecesOnlyBesideLongOnes) {
  // A wall of 1 m and one of 0.15 m at a right angle to it; then the short one alone.
  const auto at = [](double x, double y) { return Eigen::Vector2d(x, y); };
  std::vector<Eigen::Vector2d> contour;
  for (int i = 0; i < 60; ++i) contour.push_back(at(2.0, -0.5 + i / 60.0));
  for (int i = 0; i < 12; ++i) contour.push_back(at(2.0 - 0.0125 * (i + 1), 0.5 + 1e-6 * i));
  std::vector<double> bearings;
  std::vector<double> ranges;
  for (const Eigen::Vector2d& p : contour) {
    bearings.push_back(std::atan2(p.y(), p.x()));
    ranges.push_back(p.norm());
  }
  const Points points = points_from(bearings, ranges);
  SegmentationParameters parameters;
  parameters.refine = false;
  parameters.breakpoint_angle = 0.02;
  EXPECT_THAT(build(points, {{0, 60}, {60, 72}}, parameters),
              ElementsAre(Segment{0, 60}, Segment{60, 72}));
  EXPECT_THAT(build(points, {{60, 72}}, parameters), IsEmpty());
}

TEST(SegmentBuilder, WantsSegmentsLongerThanTheirToleranceIsWide) {
  std::mt19937_64 engine(1);
  const Points wall = wall_points({0.0, 2.0}, -0.08, 0.08, 40, {}, engine);  // 0.32 m
  EXPECT_EQ(build(wall, {{0, 40}}, {}, {0.010, 0.0, 0.0}).size(), 1U);
  EXPECT_THAT(build(wall, {{0, 40}}, {}, {0.050, 0.0, 0.0}), IsEmpty());  // 0.4 m wide
}

}  // namespace
}  // namespace quoin
