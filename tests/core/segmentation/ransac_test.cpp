// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/segmentation/ransac.hpp"

#include <cmath>

#include <gmock/gmock.h>

#include "tests/core/segmentation/segmenter_scans.hpp"
#include "tests/core/wall_points.hpp"

namespace quoin {
namespace {

Ransac::Parameters bare(int seed) {
  Ransac::Parameters parameters;
  parameters.merge = false;
  parameters.refine = false;
  parameters.seed = seed;
  return parameters;
}

TEST(Ransac, FindsARoomWithAnySeed) {
  const Points points = noisy_points("square_room", 2);
  for (int seed = 0; seed < 30; ++seed) {
    EXPECT_EQ(long_ones(segments_by<Ransac>(points, bare(seed)), 200).size(), 4U) << seed;
  }
}

TEST(Ransac, DependsOnTheSeedAlone) {
  const Points points = noisy_points("environment_b", 2);
  const auto segments = [&points](int seed) {
    auto parameters = bare(seed);
    parameters.trials = 1;
    return segments_by<Ransac>(points, parameters);
  };
  std::size_t different = 0;
  for (int seed = 0; seed < 10; ++seed) {
    EXPECT_EQ(segments(seed), segments(seed));
    different += segments(seed) != segments(seed + 1) ? 1 : 0;
  }
  EXPECT_GE(different, 5U);
}

TEST(Ransac, TakesMoreThanOneTrialForACurvedSurface) {
  // Walls on both sides of a bow: whichever pair is drawn, something is found, but the long wall
  // needs a pair that lies on it.
  std::vector<double> bearings;
  std::vector<double> ranges;
  for (int i = 0; i < 300; ++i) {
    const double bearing = 0.005 * i;
    bearings.push_back(bearing);
    const double bow = 2.0 + 1e-4 * (i % 2);  // no fill value
    ranges.push_back(i < 240 ? bow : 2.0 / std::cos(bearing - 1.2));
  }
  const Points points = points_from(bearings, ranges);
  const auto longest = [&points](int trials) {
    std::size_t sum = 0;
    for (int seed = 0; seed < 20; ++seed) {
      auto parameters = bare(seed);
      parameters.trials = trials;
      std::size_t most = 0;
      for (const Segment& segment : segments_by<Ransac>(points, parameters)) {
        most = std::max(most, segment.size());
      }
      sum += most;
    }
    return sum / 20;
  };
  EXPECT_GE(longest(60), 120U);
  EXPECT_GT(longest(60), longest(1));
}

TEST(Ransac, LeavesClutterOut) {
  // Blobs with 20 points of noise of 10 cm between walls: the runs there are short.
  std::mt19937_64 engine(8);
  std::normal_distribution<double> normal(0.0, 0.1);
  std::vector<double> bearings;
  std::vector<double> ranges;
  for (int i = 0; i < 120; ++i) {
    bearings.push_back(-0.6 + 0.01 * i);
    const bool clutter = i >= 50 && i < 70;
    ranges.push_back(2.0 / std::cos(bearings.back()) - (clutter ? 0.5 + normal(engine) : 0.0));
  }
  auto parameters = bare(1);
  parameters.breakpoint_angle = 0.013;
  parameters.min_points = 10;
  const auto segments =
      segments_by<Ransac>(points_from(bearings, ranges), parameters, {0.0, 0.0, 0.0});
  EXPECT_THAT(segments, testing::ElementsAre(Segment{0, 50}, Segment{70, 120}));
}

}  // namespace
}  // namespace quoin
