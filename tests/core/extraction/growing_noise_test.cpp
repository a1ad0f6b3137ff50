// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
// From scans to corners where the noise is 1 % of the range: near walls and far walls of one scan.
#include <array>
#include <cmath>

#include <Eigen/LU>
#include <gtest/gtest.h>

#include "core/corners/corner_finders.hpp"
#include "core/extraction/extraction.hpp"
#include "core/fitting/fitters.hpp"
#include "core/geometry/angle.hpp"
#include "core/segmentation/segmenters.hpp"
#include "core/simulation/scanner.hpp"
#include "core/statistics/chi_square.hpp"

namespace quoin {
namespace {

constexpr std::array<double, 4> distances{7.0, 5.0, 1.0, 1.2};  // [m] of the walls at 0, 90, ...

World room() {
  const auto [right, top, left, bottom] = distances;
  World world;
  world.add_polyline({{-left, -bottom}, {right, -bottom}, {right, top}, {-left, top}}, true);
  world.path = {{0.0, 0.0, 0.0}};
  return world;
}

class GrowingNoise : public testing::TestWithParam<const char*> {};

TEST_P(GrowingNoise, IsCoveredAtAllRanges) {
  ScannerSettings settings;
  settings.points = 360;
  settings.noise = {0.0, 0.0, 0.0, 0.01};
  SimulatedScanner scanner(room(), settings, 5);
  Extraction extraction{Segmenters::make<Segmenter>("iepf", {}),
                        Fitters::make<Fitter>(GetParam(), {}),
                        CornerFinders::make<CornerFinder>("adjacent", {})};
  constexpr int scans = 2000;
  std::array<int, 4> found{};
  std::array<int, 4> covered{};
  SimulatedScan scan;
  for (int trial = 0; trial < scans; ++trial) {
    scanner.scan(0.0, 0.0, scan);
    extraction.run(view(scan, settings), settings.noise, settings.noise);
    for (std::size_t k = 0; k < 4; ++k) {
      for (const LineSegment& line : extraction.lines()) {
        const Eigen::Vector2d error(
            normalized_angle(line.estimate.line.alpha - 0.5 * pi * static_cast<double>(k)),
            line.estimate.line.r - distances[k]);
        if (std::abs(error.x()) > 0.1 || (line.end - line.start).norm() < 2.0) continue;
        ++found[k];
        if (error.dot(line.estimate.alpha_r_covariance().inverse() * error) < chi_square_2_95)
          ++covered[k];
        break;
      }
    }
  }
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_GT(found[k], 0.99 * scans) << k;
    // The standard error of a coverage of 95 % is 0.5 %.
    EXPECT_NEAR(static_cast<double>(covered[k]) / found[k], 0.95, 0.015) << k;
  }
}

INSTANTIATE_TEST_SUITE_P(Of, GrowingNoise, testing::Values("inverse_range", "wctls", "pca"));

}  // namespace
}  // namespace quoin
