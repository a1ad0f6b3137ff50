// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/evaluation/scan_statistics.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "core/corners/corner_finders.hpp"
#include "core/fitting/fitters.hpp"
#include "core/segmentation/segmenters.hpp"

namespace quoin {
namespace {

TEST(ScanStatistics, AreThoseOfTheScans) {
  ScannerSettings settings;
  SimulatedScanner scanner(built_in_world("square_room").value(), settings, 2);
  Extraction extraction(Segmenters::make<Segmenter>("iepf", {}), Fitters::make<Fitter>("wctls", {}),
                        CornerFinders::make<CornerFinder>("adjacent", {}));
  SimulatedScan scan;
  ScanStatistics statistics;
  const SensorModel sensor;
  double least = 1.0, most = 0.0;
  for (int k = 0; k < 40; ++k) {
    scanner.scan(0.0, 0.0, scan);
    extraction.run(view(scan, settings), sensor, sensor);
    statistics.add(extraction, sensor);
    for (const Corner& corner : extraction.corners()) {
      const double sigma = std::sqrt(0.5 * corner.estimate.covariance.trace());
      least = std::min(least, sigma);
      most = std::max(most, sigma);
    }
  }
  const ScanFigures figures = statistics.figures();
  EXPECT_EQ(figures.scans, 40U);
  EXPECT_NEAR(figures.segments_per_scan, 4.0, 0.1);
  EXPECT_NEAR(figures.corners_per_scan, 4.0, 0.1);
  EXPECT_GT(figures.median_sigma, least);
  EXPECT_LT(figures.median_sigma, most);
  // The ellipse of a corner with sigma in each of two independent directions.
  const double pi = 3.14159265358979323846;
  EXPECT_NEAR(figures.median_ellipse_area, pi * figures.median_sigma * figures.median_sigma,
              0.2 * figures.median_ellipse_area);
  // 160 walls of 230 points: standard error of the median 0.01.
  EXPECT_NEAR(figures.median_reduced_chi_square, 1.0, 0.06);
  EXPECT_NEAR(static_cast<double>(figures.failures[static_cast<std::size_t>(FitFailure::none)]),
              160.0, 4.0);
}

TEST(ScanStatistics, OfNothingAreZero) {
  const ScanFigures figures = ScanStatistics().figures();
  EXPECT_EQ(figures.scans, 0U);
  EXPECT_EQ(figures.corners_per_scan, 0.0);
  EXPECT_EQ(figures.median_sigma, 0.0);
}

}  // namespace
}  // namespace quoin
