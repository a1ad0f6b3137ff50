// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/extraction/feature_extractor.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <gmock/gmock.h>

#include "core/corners/corner_finders.hpp"
#include "core/fitting/fitters.hpp"
#include "core/segmentation/segmenters.hpp"
#include "core/simulation/scanner.hpp"
#include "core/simulation/world.hpp"
#include "tests/allocations.hpp"
#include "tests/core/matchers.hpp"

namespace quoin {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

/// A scan from the middle of a room of 4 m by 3 m: the way to each wall along each ray.
struct ScanOfARoom {
  std::vector<float> bearings, ranges;

  explicit ScanOfARoom(std::size_t rays) {
    for (std::size_t i = 0; i < rays; ++i) {
      const double bearing = 2.0 * pi * static_cast<double>(i) / static_cast<double>(rays);
      const double range =
          std::min(2.0 / std::abs(std::cos(bearing)), 1.5 / std::abs(std::sin(bearing)));
      bearings.push_back(static_cast<float>(bearing));
      ranges.push_back(static_cast<float>(range));
    }
  }
  [[nodiscard]] ScanView view() const { return {.bearings = bearings, .ranges = ranges}; }
};

TEST(FeatureExtractor, FindsTheWallsAndCornersOfARoom) {
  const ScanOfARoom scan(720);
  FeatureExtractor extract({.range_stddev = 0.01, .bearing_stddev = 0.0});
  const Features found = extract(scan.view());
  ASSERT_THAT(found.segments, SizeIs(4));
  ASSERT_THAT(found.lines, SizeIs(4));
  ASSERT_THAT(found.corners, SizeIs(4));
  EXPECT_THAT(found.failures, IsEmpty());
  EXPECT_EQ(found.points.size(), 720U);
  for (const LineSegment& line : found.lines) {
    const bool side = std::abs(std::cos(line.estimate.line.alpha)) > 0.5;
    EXPECT_NEAR(line.estimate.line.r, side ? 2.0 : 1.5, 1e-4);
  }
  for (const Corner& corner : found.corners) {
    EXPECT_NEAR(std::abs(corner.estimate.position.x()), 2.0, 1e-4);
    EXPECT_NEAR(std::abs(corner.estimate.position.y()), 1.5, 1e-4);
    EXPECT_GT(corner.estimate.covariance.determinant(), 0.0);
    EXPECT_LT(corner.estimate.covariance.trace(), 0.01 * 0.01);
  }
}

TEST(FeatureExtractor, TheCovarianceIsThatOfTheSensor) {
  const ScanOfARoom scan(720);
  FeatureExtractor fine({.range_stddev = 0.01, .bearing_stddev = 0.0});
  FeatureExtractor coarse({.range_stddev = 0.02, .bearing_stddev = 0.0});
  const Eigen::Matrix2d covariance = fine(scan.view()).lines[0].estimate.covariance;
  EXPECT_THAT(coarse(scan.view()).lines[0].estimate.covariance,
              CovarianceNear(Eigen::Matrix2d(4.0 * covariance), 1e-9));
}

TEST(FeatureExtractor, RunsTheMethodsThatAreChosen) {
  const ScanOfARoom scan(720);
  FeatureExtractor extract(
      {}, {.segmenter = {"split_and_merge", {{"min_length", "10 m"}}}, .fitter = {"wctls"}});
  EXPECT_THAT(extract(scan.view()).lines, IsEmpty());
}

TEST(FeatureExtractor, TheDefaultsAreThoseOfTheServices) {
  const MethodChain methods;
  EXPECT_EQ(methods.segmenter.method, Segmenters::descriptions().front().name);
  EXPECT_EQ(methods.fitter.method, Fitters::descriptions().front().name);
  EXPECT_EQ(methods.finder.method, CornerFinders::descriptions().front().name);
}

/// Scans on a way through furniture, some of them with what sensors write where nothing came back,
/// and with points in front of walls.
std::vector<SimulatedScan> varied_scans() {
  SimulatedScanner scanner(built_in_world("domestic_room").value(), {}, 7);
  std::vector<SimulatedScan> scans(24);
  for (std::size_t i = 0; i < scans.size(); ++i) {
    scanner.scan(0.05 * static_cast<double>(i), 0.0, scans[i]);
    std::vector<float>& ranges = scans[i].ranges;
    if (i % 3 == 0) std::fill(ranges.begin() + 100, ranges.begin() + 140, 8.0F);
    if (i % 4 == 0) {
      for (std::size_t k = 200; k < ranges.size(); k += 90) ranges[k] *= 0.5F;
    }
  }
  return scans;
}

/// Allocations of the second time that an extractor sees these scans.
std::size_t allocations_with(const MethodChain& methods, const std::vector<SimulatedScan>& scans) {
  FeatureExtractor extract({}, methods);
  std::size_t lines = 0;
  std::size_t again = 0;
  for (const SimulatedScan& scan : scans) lines += extract(view(scan, {})).lines.size();
  const tests::Allocations allocations;
  for (const SimulatedScan& scan : scans) again += extract(view(scan, {})).lines.size();
  const std::size_t count = allocations.count();
  EXPECT_EQ(again, lines);
  EXPECT_GT(lines, 5 * scans.size());
  return count;
}

TEST(FeatureExtractor, AllocatesNothingOnceItHasSeenSuchScans) {
  const std::vector<SimulatedScan> scans = varied_scans();
  for (const MethodInfo& fitter : Fitters::descriptions()) {
    EXPECT_EQ(allocations_with({.fitter = {fitter.name}}, scans), 0U) << fitter.name;
  }
  for (const MethodInfo& segmenter : Segmenters::descriptions()) {
    EXPECT_EQ(allocations_with({.segmenter = {segmenter.name}}, scans), 0U) << segmenter.name;
  }
}

TEST(FeatureExtractor, TheAllocationsOfMethodsAreSeen) {
  const ScanOfARoom scan(920);
  const tests::Allocations allocations;
  FeatureExtractor extract;
  (void)extract(scan.view());
  EXPECT_GT(allocations.count(), 10U);
}

TEST(FeatureExtractor, AScanWithoutPointsHasNoFeatures) {
  const std::vector<float> bearings{0.0F, 0.1F, 0.2F};
  const std::vector<float> ranges{std::numeric_limits<float>::quiet_NaN(), 0.0F, -1.0F};
  FeatureExtractor extract;
  const Features found = extract({.bearings = bearings, .ranges = ranges});
  EXPECT_EQ(found.points.size(), 0U);
  EXPECT_THAT(found.segments, IsEmpty());
  EXPECT_THAT(extract({}).corners, IsEmpty());
}

std::string error_of(const SensorModel& sensor, const MethodChain& methods) {
  try {
    FeatureExtractor extract(sensor, methods);
  } catch (const ParameterError& error) {
    return error.what();
  }
  return "";
}

TEST(FeatureExtractor, NamesWhatCannotBeUsed) {
  EXPECT_THAT(error_of({}, {.fitter = {"wclts"}}),
              AllOf(HasSubstr("wclts"), HasSubstr("did you mean 'wctls'?")));
  EXPECT_THAT(error_of({}, {.segmenter = {"iepf", {{"split_distance", "3 s"}}}}),
              AllOf(HasSubstr("iepf"), HasSubstr("split_distance"), HasSubstr("not a length")));
  EXPECT_THAT(error_of({.range_stddev = -0.01}, {}),
              AllOf(HasSubstr("range_stddev"), HasSubstr("-0.01")));
  EXPECT_THAT(error_of({.bearing_stddev = std::numeric_limits<double>::quiet_NaN()}, {}),
              HasSubstr("bearing_stddev"));
}

}  // namespace
}  // namespace quoin
