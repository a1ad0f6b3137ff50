// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/evaluation/scan_consistency.hpp"

#include <cmath>
#include <functional>

#include <gtest/gtest.h>

#include "core/corners/corner_finders.hpp"
#include "core/fitting/fitters.hpp"
#include "core/segmentation/segmenters.hpp"
#include "core/simulation/random.hpp"
#include "core/simulation/scanner.hpp"
#include "core/simulation/world.hpp"

namespace quoin {
namespace {

constexpr auto odd_even = static_cast<std::size_t>(SplitTest::odd_even);
constexpr auto halves = static_cast<std::size_t>(SplitTest::halves);
constexpr auto at_rest = static_cast<std::size_t>(SplitTest::at_rest);

struct Conditions {
  SensorModel noise;   ///< of the simulated scans
  SensorModel model;   ///< that is judged
  double speed = 0.0;  ///< [m/s]
  bool pose_known = false;
  std::function<void(SimulatedScan&)> change = {};  ///< of each scan
  std::size_t scans = 200;
};

/// Scans of the room of 4 x 4 m: four walls of 230 points.
ScanConsistencyFigures judge(const Conditions& conditions) {
  Extraction extraction(Segmenters::make<Segmenter>("iepf", {}),
                        Fitters::make<Fitter>("inverse_range", {}),
                        CornerFinders::make<CornerFinder>("adjacent", {}));
  ScanConsistency consistency(Fitters::make<Fitter>("inverse_range", {}), conditions.model);
  ScannerSettings settings;
  settings.noise = conditions.noise;
  const World world = built_in_world("square_room").value();
  SimulatedScanner scanner(world, settings, 5);
  SimulatedScan scan;
  for (std::size_t k = 0; k < conditions.scans; ++k) {
    const double distance = 0.1 * conditions.speed * static_cast<double>(k);
    scanner.scan(distance, 0.0, scan);
    if (conditions.change) conditions.change(scan);
    extraction.run(view(scan, settings), conditions.noise, conditions.model);
    consistency.add(extraction,
                    conditions.pose_known ? std::optional(world.pose_at(distance)) : std::nullopt);
  }
  return consistency.figures();
}

TEST(ScanConsistency, FlatWallsAreConsistentInAllTests) {
  const ScanConsistencyFigures figures = judge({{}, {}});
  EXPECT_EQ(figures.lines, 800U);
  EXPECT_NEAR(figures.reduced_chi_square.value, 1.0, 0.02);
  EXPECT_LT(figures.reduced_chi_square.low, 1.0 + 0.01);
  EXPECT_GT(figures.reduced_chi_square.high, 1.0 - 0.01);
  EXPECT_GT(figures.scans_at_rest, 190U);  // motion is seen by chance once in 100 times
  for (const DistanceFigures& test : figures.modelled) {
    EXPECT_GT(test.count, 760U);
    EXPECT_NEAR(test.inside95.value, 0.95, 0.03);  // four standard errors
    EXPECT_LT(test.inside95.low, test.inside95.value);
    EXPECT_GT(test.inside95.high, test.inside95.value);
    EXPECT_LT(test.inside95.high - test.inside95.low, 0.06);
    EXPECT_NEAR(test.median, 1.386, 0.25);
    EXPECT_NEAR(test.mean, 2.0, 0.3);
    ASSERT_EQ(test.quantiles.size(), 200U);
    EXPECT_NEAR(test.quantiles[190], 6.0, 1.2);
  }
}

TEST(ScanConsistency, NoiseThatIsLargerThanModelledShowsEverywhere) {
  SensorModel noisy;
  noisy.range_stddev = 0.020;
  noisy.bearing_stddev *= 2.0;
  const ScanConsistencyFigures figures = judge({noisy, {}});
  EXPECT_NEAR(figures.reduced_chi_square.value, 4.0, 0.1);
  for (const DistanceFigures& test : figures.modelled) {
    EXPECT_NEAR(test.inside95.value, 0.527, 0.09);  // P(chi^2_2 < 5.99 / 4)
    EXPECT_NEAR(test.mean, 8.0, 1.2);
  }
  // Scaled to the residuals, the covariances are right again.
  for (const DistanceFigures& test : figures.reported) {
    EXPECT_NEAR(test.inside95.value, 0.95, 0.04);
  }
}

TEST(ScanConsistency, WavesOfAWallShowInTheHalvesAlone) {
  const ScanConsistencyFigures figures =
      judge({{}, {}, 0.0, false, [](SimulatedScan& scan) {
               for (std::size_t i = 0; i < scan.ranges.size(); ++i) {
                 scan.ranges[i] += 0.008F * std::sin(10.0F * scan.bearings[i]);
               }
             }});
  EXPECT_NEAR(figures.modelled[odd_even].inside95.value, 0.95, 0.04);
  EXPECT_NEAR(figures.modelled[at_rest].inside95.value, 0.95, 0.04);
  EXPECT_LT(figures.modelled[halves].inside95.value, 0.6);
}

TEST(ScanConsistency, FlatnessIsLeftOutWhereBothLinesShareIt) {
  SensorModel uneven;
  uneven.flatness_stddev = 0.05;
  const ScanConsistencyFigures plain = judge({{}, {}});
  const ScanConsistencyFigures figures = judge({{}, uneven});
  EXPECT_EQ(figures.modelled[odd_even].median, plain.modelled[odd_even].median);
  EXPECT_EQ(figures.modelled[at_rest].median, plain.modelled[at_rest].median);
}

TEST(ScanConsistency, ASensorThatMovesIsNotAtRest) {
  const ScanConsistencyFigures unknown = judge({{}, {}, 0.2});
  EXPECT_LT(unknown.scans_at_rest, 20U);
  // 0.9 m, before it turns back.
  const ScanConsistencyFigures known = judge({{}, {}, 0.5, true, {}, 18});
  EXPECT_EQ(known.scans_at_rest, 0U);
  EXPECT_EQ(known.modelled[at_rest].count, 0U);
  EXPECT_TRUE(known.modelled[at_rest].quantiles.empty());
  EXPECT_EQ(judge({{}, {}, 0.0, true}).scans_at_rest, 199U);
  // Steps of 1 cm by the pose: the lines decide.
  EXPECT_LT(judge({{}, {}, 0.1, true}).scans_at_rest, 20U);
}

TEST(ScanConsistency, OfNothingIsNothing) {
  const ScanConsistency consistency(Fitters::make<Fitter>("inverse_range", {}), {});
  const ScanConsistencyFigures figures = consistency.figures();
  EXPECT_EQ(figures.lines, 0U);
  EXPECT_EQ(figures.reduced_chi_square.value, 0.0);
  EXPECT_EQ(figures.modelled[halves].count, 0U);
}

}  // namespace
}  // namespace quoin
