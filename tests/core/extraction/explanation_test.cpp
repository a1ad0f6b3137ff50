// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/extraction/explanation.hpp"

#include <string>
#include <string_view>

#include <gmock/gmock.h>

#include "core/extraction/extraction.hpp"
#include "core/segmentation/segmenters.hpp"
#include "core/simulation/random_worlds.hpp"
#include "core/simulation/scanner.hpp"

namespace quoin {
namespace {

using testing::Contains;
using testing::Field;
using testing::IsEmpty;
using testing::Not;

const MethodChain chain{{"iepf"}, {"inverse_range"}, {"adjacent"}};

/// One scan with 3 mm of noise from the origin, in a room of 6 x 6 m with other things in it.
class Scene {
 public:
  explicit Scene(const std::function<void(World&)>& furnish) {
    World world;
    world.path = {{0.0, 0.0, 0.0}};
    world.add_polyline({{-3, -3}, {3, -3}, {3, 3}, {-3, 3}}, true);
    furnish(world);
    settings_.noise.range_stddev = 0.003;
    settings_.noise.bearing_stddev = 0.0;
    SimulatedScanner(world, settings_, 1).scan(0.0, 0.0, scan_);
  }
  [[nodiscard]] ScanView scan() const { return view(scan_, settings_); }
  [[nodiscard]] const SensorModel& sensor() const { return settings_.noise; }
  [[nodiscard]] Explanation at(double x, double y, const MethodChain& methods = chain) const {
    return explain(scan(), sensor(), methods, Place::at(x, y));
  }

 private:
  ScannerSettings settings_;
  SimulatedScan scan_;
};

ParameterSettings with(const Remedy& remedy) {
  return {{remedy.parameter, detail::number_text(remedy.would)}};
}

const Remedy& named(const Explanation& found, std::string_view parameter) {
  const auto remedy = std::ranges::find(found.remedies, parameter, &Remedy::parameter);
  if (remedy == found.remedies.end())
    throw std::out_of_range("no remedy " + std::string(parameter));
  return *remedy;
}

TEST(Explanation, AWallHasItsLineAndCorners) {
  const Explanation found = Scene([](World&) {}).at(3.0, 0.5);
  EXPECT_EQ(found.outcome, PointOutcome::segment);
  EXPECT_TRUE(found.line);
  EXPECT_EQ(found.corners, 2U);
  EXPECT_NEAR(found.x, 3.0, 0.05);
  EXPECT_THAT(found.remedies, IsEmpty());
}

TEST(Explanation, AShortWallIsTooShortAndTheLengthThatWouldPassIsItsOwn) {
  const Scene scene([](World& world) { world.walls.push_back({{1.5, -0.1}, {1.5, 0.1}}); });
  const Explanation found = scene.at(1.5, 0.0);
  EXPECT_EQ(found.outcome, PointOutcome::too_short);
  const Remedy& remedy = named(found, "min_length");
  EXPECT_DOUBLE_EQ(remedy.value, 0.25);
  EXPECT_NEAR(remedy.would, 0.2, 0.02);
  // What is said to help does, and what is a little less does not.
  EXPECT_EQ(scene.at(1.5, 0.0, {{"iepf", with(remedy)}, chain.fitter, chain.finder}).outcome,
            PointOutcome::segment);
  Remedy less = remedy;
  less.would += 0.001;
  EXPECT_EQ(scene.at(1.5, 0.0, {{"iepf", with(less)}, chain.fitter, chain.finder}).outcome,
            PointOutcome::too_short);
}

TEST(Explanation, AFewPointsAreTooFew) {
  const Scene scene([](World& world) { world.walls.push_back({{2.0, -0.3}, {2.0, 0.3}}); });
  const MethodChain many{{"iepf", {{"min_points", "200"}}}, chain.fitter, chain.finder};
  const Explanation found = scene.at(2.0, 0.0, many);
  EXPECT_EQ(found.outcome, PointOutcome::too_few_points);
  const Remedy& remedy = named(found, "min_points");
  EXPECT_EQ(remedy.value, 200.0);
  // 2 atan(0.3 / 2) over 2 pi / 920: 43.6 rays meet it; some may be left out at its ends.
  EXPECT_LE(remedy.would, 44.0);
  EXPECT_GE(remedy.would, 38.0);
}

TEST(Explanation, APillarIsRound) {
  const Scene scene([](World& world) { world.pillars.push_back({{1.5, 0.0}, 0.15}); });
  EXPECT_EQ(scene.at(1.35, 0.0).outcome, PointOutcome::arc);
}

TEST(Explanation, ThinThingsInFrontOfAWallAreForeign) {
  const Scene scene([](World& world) { world.pillars.push_back({{1.5, 0.0}, 0.01}); });
  EXPECT_EQ(scene.at(1.49, 0.0).outcome, PointOutcome::foreign);
}

TEST(Explanation, WhereNothingIsTheNearestPointIsAnswered) {
  const Explanation found = Scene([](World&) {}).at(1.0, 0.0);
  EXPECT_NEAR(found.distance, 2.0, 0.05);
  EXPECT_TRUE(found.measured);
}

TEST(Explanation, ABearingMeetsTheWallInItsDirection) {
  const Scene scene([](World&) {});
  const Explanation found = explain(scene.scan(), scene.sensor(), chain, Place{1.5});
  EXPECT_NEAR(std::atan2(found.y, found.x), 1.5, 0.01);
  EXPECT_NEAR(found.y, 3.0, 0.05);
}

TEST(Explanation, AScanWithoutPointsSaysSo) {
  EXPECT_FALSE(explain({}, {}, chain, Place{0.0}).measured);
}

TEST(Explanation, NeighboursWithoutACornerAreNamedWithTheGateThatWouldLetThemMeet) {
  // A door of 0.8 m in the corner: the walls are seen to end apart from each other.
  const Scene scene([](World& room) {
    room.walls.clear();
    room.walls.push_back({{3, -3}, {3, 2.2}});
    room.walls.push_back({{2.2, 3}, {-3, 3}});
    room.walls.push_back({{-3, 3}, {-3, -3}});
    room.walls.push_back({{-3, -3}, {3, -3}});
  });
  const Explanation found = scene.at(3.0, 0.0);
  ASSERT_EQ(found.outcome, PointOutcome::segment);
  EXPECT_EQ(found.corners, 1U);
  ASSERT_EQ(found.missing_corners.size(), 1U);
  EXPECT_EQ(found.missing_corners[0].reason, "wide_gap");
  // The gap alone is not enough: the corner is 0.8 m beyond the ends, too.
  const MethodChain wide{chain.segmenter,
                         chain.fitter,
                         {"adjacent", {{"max_gap", "2"}, {"max_extrapolation", "0.3"}}}};
  const Explanation second = scene.at(3.0, 0.0, wide);
  ASSERT_EQ(second.missing_corners.size(), 1U);
  EXPECT_EQ(second.missing_corners[0].reason, "far_away");
  ASSERT_EQ(second.missing_corners[0].remedies.size(), 1U);
  EXPECT_EQ(second.missing_corners[0].remedies[0].parameter, "max_extrapolation");
  // The last ray before the end of a wall is up to 0.05 m short of it, as seen from here.
  EXPECT_GE(second.missing_corners[0].remedies[0].would, 0.78);
  EXPECT_LE(second.missing_corners[0].remedies[0].would, 0.88);
}

/// Each segmenter, in a cluttered room.
class Traced : public testing::TestWithParam<std::string> {};

TEST_P(Traced, GivesTheSameSegmentsAsUntracedAndAWordAboutEachPoint) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    ScannerSettings settings;
    SimulatedScan scan;
    SimulatedScanner(random_worlds(WorldStyle::room, 5, 3)[seed - 1], settings, seed)
        .scan(0.0, 0.0, scan);
    Points points;
    convert(view(scan, settings), points);
    const auto segment = Segmenters::make<Segmenter>(GetParam(), {});
    Segmentation plain;
    segment(points, settings.noise, plain);
    SegmentationTrace trace;
    Segmentation traced;
    traced.trace = &trace;
    segment(points, settings.noise, traced);
    EXPECT_EQ(plain.segments, traced.segments);
    EXPECT_EQ(plain.arcs, traced.arcs);
    EXPECT_EQ(plain.foreign, traced.foreign);
    ASSERT_EQ(trace.outcomes.size(), points.size());
    ASSERT_EQ(trace.surfaces.size(), points.size());
    std::size_t of_segments = 0;
    for (const Segment& run : plain.segments) {
      for (std::size_t i = run.begin; i < run.end; ++i) {
        const bool foreign = std::ranges::binary_search(plain.foreign, i);
        if (!foreign) {
          EXPECT_EQ(trace.outcomes[i], PointOutcome::segment) << i;
          ++of_segments;
        }
      }
    }
    EXPECT_EQ(static_cast<std::size_t>(std::ranges::count(trace.outcomes, PointOutcome::segment)),
              of_segments);
    EXPECT_TRUE(std::ranges::is_sorted(trace.surfaces));
  }
}

INSTANTIATE_TEST_SUITE_P(Segmenters, Traced,
                         testing::Values("iepf", "split_and_merge", "successive_edge_following",
                                         "line_tracking", "line_regression", "ransac", "hough",
                                         "expectation_maximization", "hierarchical"),
                         [](const auto& test) { return test.param; });

}  // namespace
}  // namespace quoin
