// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
// What holds for every segmenter.
#include "core/segmentation/segmenters.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include <gmock/gmock.h>

#include "core/fitting/orthogonal.hpp"
#include "tests/core/hostile_scans.hpp"
#include "tests/core/segmentation/segmenter_scans.hpp"
#include "tests/core/wall_points.hpp"

namespace quoin {
namespace {

class EverySegmenter : public testing::TestWithParam<std::string> {
 protected:
  static Segmenter make(const ParameterSettings& settings = {}) {
    return Segmenters::make<Segmenter>(GetParam(), settings);
  }
  static std::vector<Segment> run(Segmenter& segmenter, const Points& points,
                                  const SensorModel& sensor = {}) {
    Segmentation found{.segments = {{7, 9}}, .arcs = {{7, 9}}, .foreign = {8}};
    segmenter(points, sensor, found);
    return found.segments;
  }
};

TEST_P(EverySegmenter, SplitsARoomIntoItsFourWalls) {
  Segmenter segmenter = make();
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    const auto segments = run(segmenter, noisy_points("square_room", seed));
    // A quarter of 920 points each, less a few at the corners.
    EXPECT_EQ(long_ones(segments, 200).size(), 4U) << seed;
    EXPECT_LE(segments.size(), 6U) << seed;
  }
}

/// How far the points of a segment are from their own line, in tolerances.
double worst_distance(const Points& points, const Segment& segment, const Tolerance& tolerance) {
  Moments moments;
  for (std::size_t i = segment.begin; i < segment.end; ++i) moments.add(points.x[i], points.y[i]);
  const OrthogonalLine fit = orthogonal_line(moments);
  if (!fit.ok()) return 0.0;
  double worst = 0.0;
  for (std::size_t i = segment.begin; i < segment.end; ++i) {
    const double distance = fit.line.distance(points.x[i], points.y[i]);
    const double allowed = tolerance.squared(points, i, fit.line.normal_x, fit.line.normal_y);
    worst = std::max(worst, std::abs(distance) / std::sqrt(allowed));
  }
  return worst;
}

TEST_P(EverySegmenter, GivesStraightPiecesInOrder) {
  Segmenter segmenter = make();
  const SegmentationParameters defaults;
  for (const std::string& world : world_names()) {
    for (std::uint64_t seed = 0; seed < 10; ++seed) {
      Points points = noisy_points(world.c_str(), seed);
      const Tolerance tolerance(defaults, SensorModel{}, points);
      Segmentation all;
      segmenter(points, SensorModel{}, all);
      set_aside(points, all);
      std::size_t free_from = 0;
      for (const Segment& segment : all.segments) {
        EXPECT_GE(segment.begin, free_from);
        EXPECT_LE(segment.end, points.size());
        EXPECT_GE(segment.size(), static_cast<std::size_t>(defaults.min_points));
        free_from = segment.end;
        // A line may tilt by one tolerance, and a mild outlier is within two.
        EXPECT_LE(worst_distance(points, segment, tolerance), 3.0)
            << world << seed << ": " << segment.begin << " to " << segment.end;
      }
    }
  }
}

// In clutter, where pieces are split, joined over others and dropped.
TEST_P(EverySegmenter, GivesRunsThatAreApartAndForeignPointsInOrder) {
  Segmenter segmenter = make();
  const SensorModel noise;
  for (const World& world : cluttered_rooms(40, 8)) {
    const ScannedWorld scanned = scan_of(world, noise, 1);
    Points points = scanned.points;
    Segmentation found;
    segmenter(points, noise, found);
    std::size_t next = 0;
    for (const std::size_t foreign : found.foreign) {
      EXPECT_GE(foreign, next);
      EXPECT_LT(foreign, points.size());
      next = foreign + 1;
    }
    const std::size_t lines = found.segments.size();
    set_aside(points, found);
    EXPECT_EQ(points.size(), scanned.points.size());
    EXPECT_EQ(found.segments.size(), lines);
    for (const std::vector<Segment>& runs : {found.segments, found.arcs}) {
      std::size_t free_from = 0;
      for (const Segment& run : runs) {
        EXPECT_GE(run.begin, free_from);
        EXPECT_GT(run.end, run.begin);
        free_from = run.end;
      }
      EXPECT_LE(free_from, points.size());
    }
    // Arcs may be of what stands in front of a wall, segments not.
    if (!found.segments.empty()) {
      EXPECT_LE(found.segments.back().end, points.size() - found.foreign.size());
    }
  }
}

constexpr std::size_t no_wall = Hit::no_wall;

/// The wall nearest to each point, none when all are farther than 7 cm, which is at least 4
/// standard deviations of the noise where the walls of the built-in worlds are.
std::vector<std::size_t> nearest_walls(const World& world, const ScannedWorld& scanned) {
  std::vector<std::size_t> walls;
  for (std::size_t i = 0; i < scanned.points.size(); ++i) {
    const Eigen::Vector2d point(scanned.points.x[i], scanned.points.y[i]);
    double nearest = 0.07;
    walls.push_back(no_wall);
    for (std::size_t k = 0; k < world.walls.size(); ++k) {
      const Eigen::Vector2d start = scanned.pose.inverse_transform(world.walls[k].start);
      const Eigen::Vector2d along = scanned.pose.inverse_transform(world.walls[k].end) - start;
      const double place = along.dot(point - start) / along.squaredNorm();
      const double distance = (point - start - std::clamp(place, 0.0, 1.0) * along).norm();
      if (distance >= nearest) continue;
      nearest = distance;
      walls.back() = k;
    }
  }
  return walls;
}

/// Runs of at least 40 points on one wall.
std::vector<Segment> long_walls(const std::vector<std::size_t>& walls) {
  std::vector<Segment> runs;
  for (std::size_t begin = 0; begin < walls.size();) {
    std::size_t end = begin;
    while (end < walls.size() && walls[end] == walls[begin]) ++end;
    if (walls[begin] != no_wall && end - begin >= 40) runs.push_back({begin, end});
    begin = end;
  }
  return runs;
}

TEST_P(EverySegmenter, FindsTheLongWallsOfEveryWorld) {
  Segmenter segmenter = make();
  for (const std::string& name : world_names()) {
    const World world = built_in_world(name).value();
    double walls = 0.0;
    double found = 0.0;
    for (std::uint64_t seed = 0; seed < 10; ++seed) {
      const ScannedWorld scanned = scan_of(world, SensorModel{}, seed, 0.4 * seed);
      const auto segments = run(segmenter, scanned.points);
      const auto labels = nearest_walls(world, scanned);
      for (const Segment& wall : long_walls(labels)) {
        ++walls;
        found += std::any_of(segments.begin(), segments.end(), [&](const Segment& segment) {
          const std::size_t begin = std::max(wall.begin, segment.begin);
          const std::size_t end = std::min(wall.end, segment.end);
          if (end <= begin || 10 * (end - begin) < 7 * wall.size()) return false;
          // It may go on behind something.
          std::size_t on_wall = 0;
          std::size_t on_others = 0;
          for (std::size_t i = segment.begin; i < segment.end; ++i) {
            on_wall += labels[i] == labels[wall.begin] ? 1 : 0;
            on_others += labels[i] != labels[wall.begin] && labels[i] != no_wall ? 1 : 0;
          }
          return on_wall * 3 >= on_others * 7;  // 70 % of the segment
        });
      }
    }
    EXPECT_GE(walls, 40.0) << name;
    EXPECT_GE(found / walls, 0.9) << name;
  }
}

TEST_P(EverySegmenter, IsAFunctionOfTheScan) {
  Segmenter used = make();
  for (const char* world : {"domestic_room", "environment_a", "environment_b"}) {
    const Points points = noisy_points(world, 3);
    Segmenter fresh = make();
    const auto expected = run(fresh, points);
    EXPECT_FALSE(expected.empty());
    EXPECT_EQ(run(fresh, points), expected) << world << " again";
    EXPECT_EQ(run(used, points), expected) << world << " after another scan";
  }
}

TEST_P(EverySegmenter, TakesAnyNumberOfPoints) {
  for (const bool refine : {false, true}) {
    Segmenter segmenter =
        make({{"min_points", "2"}, {"min_length", "0"}, {"refine", refine ? "true" : "false"}});
    EXPECT_TRUE(run(segmenter, Points{}).empty());
    EXPECT_TRUE(run(segmenter, points_from({0.1}, {1.0})).empty());
    EXPECT_TRUE(run(segmenter, points_from({0.1, 0.1}, {1.0, 1.0})).empty());
    for (const std::size_t count : {3U, 50U}) {
      const std::vector<double> bearings(count, 0.1);
      EXPECT_TRUE(run(segmenter, points_from(bearings, std::vector<double>(count, 1.0))).empty());
    }
    for (std::size_t count = 2; count < 40; ++count) {
      const Points points = exact_wall_points({0.3, 1.5}, 0.0, 0.01 * count, count);
      for (const Segment& segment : run(segmenter, points)) EXPECT_LE(segment.end, count);
    }
  }
}

TEST_P(EverySegmenter, TakesPointsThatAreNoWall) {
  std::mt19937_64 engine(5);
  std::uniform_real_distribution<double> range(0.2, 30.0);
  std::vector<double> bearings;
  std::vector<double> saw;
  std::vector<double> random;
  for (int i = 0; i < 2000; ++i) {
    bearings.push_back(i * 0.003 - 3.0);
    saw.push_back(i % 2 == 0 ? 2.0 : 2.3);
    random.push_back(range(engine));
  }
  Segmenter segmenter = make();
  EXPECT_TRUE(run(segmenter, points_from(bearings, saw), {0.0, 0.0, 0.0}).empty());
  EXPECT_TRUE(run(segmenter, points_from(bearings, random), {0.0, 0.0, 0.0}).empty());
  // All points on one ray: a wall through the sensor, or none, but no failure.
  const std::vector<double> same(bearings.size(), 0.4);
  for (const Segment& segment : run(segmenter, points_from(same, random))) {
    EXPECT_LE(segment.end, same.size());
  }
}

TEST_P(EverySegmenter, LeavesAStraightWallWhole) {
  Segmenter segmenter = make();
  const Points points = exact_wall_points({0.3, 1.5}, -0.9, 1.3, 300);
  // But for the points at its ends.
  EXPECT_THAT(run(segmenter, points), testing::ElementsAre(Segment{1, 299}));
  EXPECT_THAT(run(segmenter, points, {0.0, 0.0, 0.0}), testing::ElementsAre(Segment{1, 299}));
}

TEST_P(EverySegmenter, FindsTheCornerOfTwoWalls) {
  Segmenter segmenter = make();
  for (const Eigen::Vector2d& corner : {Eigen::Vector2d(2.0, 2.0), Eigen::Vector2d(1.4, 0.4)}) {
    const Points points =
        polyline_points({{corner.x(), -1.8}, corner, {corner.x() - 2.5, corner.y() + 0.6}});
    const auto segments = run(segmenter, points);
    ASSERT_EQ(segments.size(), 2U) << corner.x();
    const double vertex = static_cast<double>(nearest_point(points, corner));
    EXPECT_NEAR(static_cast<double>(segments[0].end), vertex, 3.0);
    EXPECT_NEAR(static_cast<double>(segments[1].begin), vertex, 3.0);
    EXPECT_EQ(segments[0].begin, 1U);
    EXPECT_EQ(segments[1].end, points.size() - 1);
  }
}

TEST_P(EverySegmenter, DropsShortSegments) {
  Segmenter segmenter = make();
  EXPECT_TRUE(run(segmenter, exact_wall_points({0.0, 1.0}, -0.04, 0.04, 20)).empty());  // 8 cm
  EXPECT_TRUE(run(segmenter, exact_wall_points({0.0, 1.0}, -0.2, 0.2, 5)).empty());     // 5 points
}

// With work that grows with the square of the points each of these takes minutes.
TEST_P(EverySegmenter, EndsWithTheLargestScanWhateverItShows) {
  constexpr std::size_t count = 100'000;
  Segmenter segmenter = make();
  for (const std::string_view shape : hostile_shapes) {
    const Points points = hostile_scan(shape, count);
    std::size_t end = 0;
    for (const Segment& segment : run(segmenter, points, {0.01, 0.0, 0.0})) {
      EXPECT_GE(segment.begin, end) << shape;
      EXPECT_GT(segment.end, segment.begin) << shape;
      end = segment.end;
    }
    EXPECT_LE(end, points.size()) << shape;
  }
}

TEST_P(EverySegmenter, IsNotCutShortByARoom) {
  Segmentation found;
  found.cut_short = true;
  make()(noisy_points("square_room", 1), {}, found);
  EXPECT_FALSE(found.cut_short);
}

TEST(CutShort, IsSaidWhereTheWorkForAScanHasABound) {
  for (const std::string method : {"iepf", "split_and_merge", "expectation_maximization"}) {
    const auto segmenter = Segmenters::make<Segmenter>(method, {});
    bool any = false;
    for (const std::string_view shape : hostile_shapes) {
      Segmentation found;
      segmenter(hostile_scan(shape, 100'000), {0.01, 0.0, 0.0}, found);
      any = any || found.cut_short;
    }
    EXPECT_TRUE(any) << method;
  }
}

INSTANTIATE_TEST_SUITE_P(All, EverySegmenter, testing::ValuesIn(segmenter_names()),
                         [](const auto& test) { return test.param; });

}  // namespace
}  // namespace quoin
