// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/calibration/running_noise.hpp"

#include <cmath>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/simulation/random.hpp"

namespace quoin {
namespace {

class RunningNoiseTest : public testing::Test {
 protected:
  /// Scans of five walls of 40 rays; returns the events in turn, without `none`.
  std::vector<RunningNoise::Event> run(int scans, double stddev) {
    std::vector<RunningNoise::Event> events;
    for (int i = 0; i < scans; ++i) {
      Points points;
      points.resize(200);
      std::vector<Segment> walls;
      for (std::size_t wall = 0; wall < 5; ++wall) {
        const double distance = random_.uniform(1.0, 5.0);
        const double first = random_.uniform(-1.0, 0.7);
        for (std::size_t k = 0; k < 40; ++k) {
          const double incidence = first + 0.008 * static_cast<double>(k);
          points.bearing[40 * wall + k] = incidence;
          points.range[40 * wall + k] = distance / std::cos(incidence) + stddev * random_.normal();
        }
        walls.push_back({40 * wall, 40 * wall + 40});
      }
      compute_cartesian(points);
      const RunningNoise::Event event = noise_.add(points, walls);
      if (event != RunningNoise::Event::none) events.push_back(event);
    }
    return events;
  }

  Random random_{3};
  RunningNoise noise_{{.block_points = 10'000, .window_points = 20'000}};
};

using Event = RunningNoise::Event;

TEST_F(RunningNoiseTest, IsKnownAfterTheFirstBlock) {
  EXPECT_TRUE(run(49, 0.02).empty());
  EXPECT_FALSE(noise_.components());
  EXPECT_EQ(run(1, 0.02), std::vector{Event::renewed});
  ASSERT_TRUE(noise_.components());
  EXPECT_NEAR(noise_.components()->range_stddev, 0.02, 0.001);
}

TEST_F(RunningNoiseTest, SteadyNoiseDoesNotJump) {
  EXPECT_EQ(run(300, 0.01), std::vector(6, Event::renewed));
  EXPECT_NEAR(noise_.components()->range_stddev, 0.01, 0.0005);
}

TEST_F(RunningNoiseTest, IsNeverNothingAndLeavesThat) {
  (void)run(200, 0.0);
  EXPECT_GE(noise_.components()->range_stddev, 1e-4);
  EXPECT_LT(noise_.components()->range_stddev, 0.001);
  EXPECT_THAT(run(200, 0.01), testing::Contains(Event::jump));
  EXPECT_NEAR(noise_.components()->range_stddev, 0.01, 0.001);
}

TEST_F(RunningNoiseTest, FollowsAJumpAtOnce) {
  run(200, 0.01);
  EXPECT_EQ(run(50, 0.03), std::vector{Event::jump});
  EXPECT_NEAR(noise_.components()->range_stddev, 0.03, 0.0015);
  EXPECT_EQ(run(50, 0.03), std::vector{Event::renewed});
  EXPECT_EQ(run(50, 0.01), std::vector{Event::jump});
  EXPECT_NEAR(noise_.components()->range_stddev, 0.01, 0.0005);
}

TEST_F(RunningNoiseTest, ForgetsWhatIsOutsideOfTheWindow) {
  run(100, 0.01);
  // Not a jump each, so that only the window forgets.
  run(50, 0.013);
  run(100, 0.016);
  EXPECT_NEAR(noise_.components()->range_stddev, 0.016, 0.0008);
}

}  // namespace
}  // namespace quoin
