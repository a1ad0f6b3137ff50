// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
// From scans to corners, against the true corners of the built-in worlds.
#include <algorithm>
#include <cmath>
#include <vector>

#include <Eigen/LU>
#include <gtest/gtest.h>

#include "core/corners/corner_finders.hpp"
#include "core/extraction/extraction.hpp"
#include "core/fitting/fitters.hpp"
#include "core/segmentation/segmenters.hpp"
#include "core/simulation/scanner.hpp"
#include "core/statistics/chi_square.hpp"

namespace quoin {
namespace {

Extraction extraction_with(const char* fitter) {
  return {Segmenters::make<Segmenter>("iepf", {}), Fitters::make<Fitter>(fitter, {}),
          CornerFinders::make<CornerFinder>("adjacent", {})};
}

struct Expectation {
  const char* world;
  std::size_t points;
  double corners;  // at least, on average
};

class BuiltInWorld : public testing::TestWithParam<Expectation> {};

TEST_P(BuiltInWorld, HasItsCornersFoundWhereTheyAre) {
  const World world = built_in_world(GetParam().world).value();
  ScannerSettings settings;
  settings.points = GetParam().points;
  SimulatedScanner scanner(world, settings, 99);
  const std::vector<Eigen::Vector2d> truth = world.corners();
  const Pose2 pose = world.pose_at(0.0);
  Extraction extraction = extraction_with("wctls");
  SimulatedScan scan;
  const SensorModel sensor;
  const int scans = 120;
  double found = 0.0, near = 0.0, covered = 0.0;
  for (int k = 0; k < scans; ++k) {
    scanner.scan(0.0, 0.0, scan);
    extraction.run(view(scan, settings), sensor, sensor);
    ASSERT_TRUE(extraction.failures().empty());
    for (const Corner& corner : extraction.corners()) {
      double nearest = 1e9;
      for (const Eigen::Vector2d& point : truth) {
        const Eigen::Vector2d error = corner.estimate.position - pose.inverse_transform(point);
        nearest = std::min(nearest, error.dot(corner.estimate.covariance.inverse() * error));
      }
      ++found;
      near += nearest <= 16.0 ? 1 : 0;
      covered += nearest <= chi_square_2_95 ? 1 : 0;
    }
  }
  EXPECT_GE(found / scans, GetParam().corners);
  EXPECT_GE(near / found, 0.99);
  // With segmentation in the loop; 95 % would be perfect, 500 to 2500 corners tell to 1 to 2 %.
  EXPECT_NEAR(covered / found, 0.95, 0.025);
}

INSTANTIATE_TEST_SUITE_P(All, BuiltInWorld,
                         testing::Values(Expectation{"domestic_room", 920, 11.0},
                                         Expectation{"environment_a", 935, 16.0},
                                         Expectation{"environment_b", 887, 20.0},
                                         Expectation{"corridor", 920, 4.0},
                                         Expectation{"square_room", 920, 3.95}),
                         [](const auto& test) { return std::string(test.param.world); });

}  // namespace
}  // namespace quoin
