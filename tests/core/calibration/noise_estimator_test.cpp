// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/calibration/noise_estimator.hpp"

#include <cmath>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/calibration/quantization.hpp"
#include "core/geometry/angle.hpp"
#include "core/simulation/random.hpp"

namespace quoin {
namespace {

/// A sensor and walls as the test wants them.
struct Truth {
  double range = 0.01;  // [m]
  double growth = 0.0;
  double bearing = 0.0005;   // [rad]
  double step = 0.0;         // [m] of the ranges
  double unevenness = 0.0;   // [m] of each half of a wall by itself
  double interlace = 0.0;    // [m] of all odd rays of a scan
  double noisy_walls = 0.0;  // share of walls with ten times the noise
};

/// Scans of four walls, 1 to 8 m away and of 10 to 70 rays at 0.4 deg, met at up to 70 deg.
class NoiseEstimatorTest : public testing::Test {
 protected:
  void scan(const Truth& truth, NoiseEstimator& estimator) {
    Points points;
    std::vector<Segment> walls;
    const double odd = truth.interlace * random_.normal();
    for (int wall = 0; wall < 4; ++wall) {
      const std::size_t count = 10 + random_.index(60);
      const std::size_t begin = points.size();
      const double distance = random_.uniform(1.0, 4.0);
      const double first = random_.uniform(-70.0, 70.0 - 0.4 * static_cast<double>(count));
      const double factor = random_.uniform() < truth.noisy_walls ? 10.0 : 1.0;
      points.resize(begin + count);
      double offset = 0.0;
      double slope = 0.0;
      for (std::size_t i = 0; i < count; ++i) {
        const double incidence = (first + 0.4 * static_cast<double>(i)) * pi / 180.0;
        const std::size_t half = count / 2;
        if (i == 0 || i == half) {
          // Offset and direction about the middle of this half, as SensorModel says.
          const std::size_t rays = i == 0 ? half : count - half;
          const double last = incidence + 0.4 * static_cast<double>(rays - 1) * pi / 180.0;
          const double length = distance * (std::tan(last) - std::tan(incidence));
          slope = std::sqrt(12.0) * truth.unevenness / length * random_.normal();
          offset = truth.unevenness * random_.normal() -
                   slope * distance * 0.5 * (std::tan(last) + std::tan(incidence));
        }
        const double along = distance * std::tan(incidence);
        double range = std::hypot(along, distance);
        range += (offset + slope * along) / std::cos(incidence);
        range += factor * std::hypot(truth.range, truth.growth * range) * random_.normal();
        if (((begin + i) & 1U) != 0) range += odd;
        if (truth.step > 0.0) range = truth.step * std::round(range / truth.step);
        points.range[begin + i] = range;
        points.bearing[begin + i] = incidence + truth.bearing * factor * random_.normal();
      }
      walls.push_back({begin, begin + count});
    }
    compute_cartesian(points);
    estimator.add(points, walls);
  }

  NoiseEstimate estimate(const Truth& truth, int scans = 300) {
    NoiseEstimator estimator;
    for (int i = 0; i < scans; ++i) scan(truth, estimator);
    return estimator.estimate();
  }

  Random random_{7};
};

bool holds(const Interval& interval, double truth) {
  return interval.low <= truth && truth <= interval.high;
}

TEST_F(NoiseEstimatorTest, FindsTheNoiseOfFlatWalls) {
  for (const double noise : {0.003, 0.01, 0.03, 0.05}) {
    const NoiseEstimate found = estimate({.range = noise, .bearing = 0.002});
    EXPECT_NEAR(found.components.range_stddev, noise, 0.03 * noise);
    EXPECT_LT(found.range_stddev_per_metre.low, 0.05 * noise);
    EXPECT_LT(found.flatness_stddev.low, 0.05 * noise);
    EXPECT_LT(found.components.flatness_stddev, 0.15 * noise);
    EXPECT_NEAR(found.components.neighbour_correlation, 0.0, 0.05);
    EXPECT_NEAR(found.reduced_chi_square, 1.0, 0.03);
    EXPECT_LT(found.refuted, 0.01);
  }
}

TEST_F(NoiseEstimatorTest, IntervalsHoldTheTruth) {
  int range = 0;
  int bearing = 0;
  int flatness = 0;
  for (int trial = 0; trial < 20; ++trial) {
    const NoiseEstimate found = estimate({.range = 0.01, .bearing = 0.002}, 100);
    range += holds(found.range_stddev, 0.01) ? 1 : 0;
    bearing += holds(found.bearing_stddev, 0.002) ? 1 : 0;
    flatness += holds(found.flatness_stddev, 0.0) ? 1 : 0;
  }
  EXPECT_GE(range, 16);
  EXPECT_GE(bearing, 14);
  EXPECT_GE(flatness, 16);
}

TEST_F(NoiseEstimatorTest, FindsWhatGrowsWithTheRange) {
  const NoiseEstimate found = estimate({.range = 0.005, .growth = 0.01});
  EXPECT_NEAR(found.components.range_stddev_per_metre, 0.01, 0.0005);
  EXPECT_TRUE(holds(found.range_stddev_per_metre, 0.01));
  EXPECT_TRUE(holds(found.range_stddev, 0.005));
}

TEST_F(NoiseEstimatorTest, FindsHowUnevenWallsAre) {
  for (const double unevenness : {0.003, 0.01}) {
    const NoiseEstimate found = estimate({.unevenness = unevenness});
    EXPECT_NEAR(found.components.flatness_stddev, unevenness, 0.15 * unevenness);
    EXPECT_GT(found.flatness_stddev.low, 0.5 * unevenness);
  }
}

TEST_F(NoiseEstimatorTest, CountsQuantizationAsNoise) {
  const NoiseEstimate found = estimate({.range = 0.005, .step = 0.01});
  EXPECT_NEAR(found.quantization, 0.01, 1e-6);
  EXPECT_TRUE(holds(found.range_stddev, std::sqrt(0.005 * 0.005 + 0.01 * 0.01 / 12.0)));
}

TEST_F(NoiseEstimatorTest, FindsTwoSweepsOfAMovingSensor) {
  const NoiseEstimate still = estimate({});
  EXPECT_LT(still.components.interlace_stddev, 0.001);
  const NoiseEstimate moving = estimate({.interlace = 0.008});
  EXPECT_NEAR(moving.components.interlace_stddev, 0.008, 0.002);
}

TEST_F(NoiseEstimatorTest, ATenthOfBadWallsDecidesNothing) {
  const NoiseEstimate found = estimate({.noisy_walls = 0.1});
  EXPECT_NEAR(found.components.range_stddev, 0.01, 0.002);
  EXPECT_GT(found.refuted, 0.05);
}

TEST_F(NoiseEstimatorTest, ItsModelHoldsForOtherScans) {
  const Truth truth{.range = 0.02, .growth = 0.005, .bearing = 0.002, .unevenness = 0.005};
  NoiseEstimator first;
  NoiseEstimator second;
  for (int i = 0; i < 200; ++i) scan(truth, first);
  for (int i = 0; i < 200; ++i) scan(truth, second);
  const NoiseComponents a = first.components();
  const NoiseComponents b = second.components();
  EXPECT_NEAR(a.range_stddev, b.range_stddev, 0.1 * truth.range);
  EXPECT_NEAR(a.flatness_stddev, b.flatness_stddev, 0.2 * truth.unevenness);
}

TEST_F(NoiseEstimatorTest, BandsShowNoiseOverRangeAndIncidence) {
  const NoiseEstimate found = estimate({.range = 0.005, .growth = 0.01});
  ASSERT_GE(found.by_range.size(), 5U);
  const NoiseBand& last = found.by_range.back();
  EXPECT_NEAR(last.measured, last.modelled, 0.15 * last.modelled);
  EXPECT_GT(last.measured, 1.5 * found.by_range.front().measured);
  ASSERT_GE(found.by_incidence.size(), 5U);
}

TEST_F(NoiseEstimatorTest, FewWallsGiveNoInterval) {
  const NoiseEstimate few = estimate({}, 3);
  EXPECT_EQ(few.walls, 12U);
  EXPECT_TRUE(std::isinf(few.range_stddev.high));
  const NoiseEstimate none = NoiseEstimator().estimate();
  EXPECT_EQ(none.walls, 0U);
  EXPECT_EQ(none.components.range_stddev, 0.0);
}

TEST_F(NoiseEstimatorTest, KeepsAsManyPointsAsItMay) {
  NoiseEstimator estimator(5000);
  for (int i = 0; i < 300; ++i) scan({}, estimator);
  const NoiseEstimate found = estimator.estimate();
  EXPECT_EQ(found.scans, 300U);
  EXPECT_LE(found.points, 5000U);
  EXPECT_GE(found.points, 2000U);
  EXPECT_NEAR(found.components.range_stddev, 0.01, 0.001);
}

TEST_F(NoiseEstimatorTest, SaysWhatIsMissing) {
  EXPECT_TRUE(gaps_of(estimate({})).empty());
  EXPECT_THAT(gaps_of(estimate({}, 3)),
              testing::IsSupersetOf({NoiseGap::few_walls, NoiseGap::few_long_walls}));
  EXPECT_THAT(gaps_of(NoiseEstimator().estimate()),
              testing::ElementsAre(NoiseGap::few_walls, NoiseGap::few_long_walls));
  EXPECT_THAT(gaps_of(estimate({.noisy_walls = 0.45})), testing::Contains(NoiseGap::no_walls));
  NoiseEstimate estimated = estimate({});
  estimated.steepest = 0.3;
  estimated.nearest = estimated.farthest = 2.0;
  estimated.middle_range_stddev = {0.01, 0.006, 0.014};
  EXPECT_THAT(gaps_of(estimated),
              testing::ElementsAre(NoiseGap::wide_interval, NoiseGap::uniform_range,
                                   NoiseGap::uniform_incidence));
}

TEST(QuantizationStep, IsFoundWhereThereIsOne) {
  Random random(1);
  for (const double step : {0.00025, 0.001, 0.00390625, 0.01, 0.05}) {
    std::vector<float> ranges(4000);
    for (float& range : ranges) {
      range = static_cast<float>(step * std::round(random.uniform(0.5, 12.0) / step));
    }
    EXPECT_NEAR(quantization_step(ranges), step, 1e-3 * step);
  }
  std::vector<float> ranges(4000);
  for (float& range : ranges) range = static_cast<float>(random.uniform(0.5, 12.0));
  EXPECT_EQ(quantization_step(ranges), 0.0);
  ranges.resize(20);
  EXPECT_EQ(quantization_step(ranges), 0.0);
}

}  // namespace
}  // namespace quoin
