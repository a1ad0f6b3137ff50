// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
// From scans to corners, against the true corners of the built-in worlds.
#include <algorithm>
#include <cmath>
#include <vector>

#include <Eigen/LU>
#include <gtest/gtest.h>

#include "core/corners/corner_finders.hpp"
#include "core/fitting/fitters.hpp"
#include "core/segmentation/segmenters.hpp"
#include "core/sensor/scan.hpp"
#include "core/simulation/scanner.hpp"

namespace quoin {
namespace {

class Extraction {
 public:
  std::vector<Segment> segments;
  std::vector<Corner> corners;

  explicit Extraction(const char* fitter, const char* covariance = "propagated")
      : fitter_(Fitters::make<Fitter>(fitter, {{"covariance", covariance}})) {}

  void run(const SimulatedScan& scan, const SensorModel& segmentation, const SensorModel& fitting) {
    convert({scan.bearings, scan.ranges, 0.1F, 40.0F}, points_);
    segmenter_(points_, segmentation, segments);
    lines_.clear();
    for (const Segment& segment : segments) {
      const PointsView view = points_.view().subview(segment.begin, segment.end);
      const FitResult fit = fitter_(view, fitting);
      ASSERT_TRUE(fit.ok());
      lines_.push_back(line_segment(fit.estimate, view));
    }
    finder_(lines_, fitting.range_bias_stddev, corners);
  }

 private:
  Points points_;
  Segmenter segmenter_ = Segmenters::make<Segmenter>("iepf", {});
  Fitter fitter_;
  CornerFinder finder_ = CornerFinders::make<CornerFinder>("adjacent", {});
  std::vector<LineSegment> lines_;
};

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
  Extraction extraction("wctls");
  SimulatedScan scan;
  const SensorModel sensor;
  const int scans = 120;
  double found = 0.0, near = 0.0, covered = 0.0;
  for (int k = 0; k < scans; ++k) {
    scanner.scan(0.0, 0.0, scan);
    extraction.run(scan, sensor, sensor);
    for (const Corner& corner : extraction.corners) {
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

double median_area(const char* fitter, const char* covariance) {
  ScannerSettings settings;
  settings.points = 935;
  SimulatedScanner scanner(built_in_world("environment_a").value(), settings, 5);
  Extraction extraction(fitter, covariance);
  // Standard deviations as the paper takes them from the data sheet.
  const SensorModel paper{0.05, 0.391 * 3.14159265358979323846 / 180.0, 0.0};
  SimulatedScan scan;
  std::vector<double> areas;
  for (int k = 0; k < 20; ++k) {
    scanner.scan(0.0, 0.0, scan);
    extraction.run(scan, SensorModel{}, paper);
    for (const Corner& corner : extraction.corners) {
      areas.push_back(one_sigma_ellipse_area(corner.estimate.covariance));
    }
  }
  std::nth_element(areas.begin(), areas.begin() + static_cast<std::ptrdiff_t>(areas.size() / 2),
                   areas.end());
  return areas[areas.size() / 2];
}

TEST(PublishedTables, FollowFromReadingEquationFiveLiterally) {
  const double wctls = median_area("wctls", "as_published");
  const double printed = median_area("utls", "as_published") / wctls;
  const double propagated = median_area("utls", "propagated") / wctls;
  RecordProperty("ratio", std::to_string(printed));
  EXPECT_GT(printed, 4.0);  // the paper: 7.2
  EXPECT_LT(printed, 14.0);
  EXPECT_NEAR(propagated, 1.0, 0.1);
}

}  // namespace
}  // namespace quoin
