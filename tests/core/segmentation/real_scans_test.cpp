// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
// What real scans hold that simulated rooms do not, from the scan to the corners, for every
// segmenter.
#include <algorithm>
#include <cmath>
#include <functional>
#include <string>

#include <Eigen/LU>
#include <gmock/gmock.h>

#include "core/corners/corner_finders.hpp"
#include "core/extraction/extraction.hpp"
#include "core/fitting/likelihood_fitters.hpp"
#include "core/simulation/random.hpp"
#include "tests/core/segmentation/segmenter_scans.hpp"

namespace quoin {
namespace {

const std::vector<Eigen::Vector2d> room{{3.0, -1.5}, {3.0, 2.0}, {-2.0, 2.0}, {-2.0, -1.5}};

class RealScans : public testing::TestWithParam<std::string> {
 protected:
  RealScans()
      : extraction_(Segmenters::make<Segmenter>(GetParam(), {}), InverseRange(),
                    CornerFinders::make<CornerFinder>("adjacent", {})) {
    world_.path = {{0.0, 0.0, 0.0}};
  }

  /// Extracts from a scan of the world; `change` may alter it before.
  void scan(std::uint64_t seed, const std::function<void(SimulatedScan&)>& change = {}) {
    settings_.noise = noise_;
    SimulatedScanner scanner(world_, settings_, seed);
    SimulatedScan scan;
    scanner.scan(0.0, 0.0, scan);
    if (change) change(scan);
    extraction_.run(view(scan, settings_), noise_, noise_);
  }

  /// Number of the true corners of the room that were found, each in its 99.99 % ellipse.
  [[nodiscard]] int true_corners() const {
    return static_cast<int>(
        std::count_if(room.begin(), room.end(), [this](const Eigen::Vector2d& truth) {
          return std::any_of(
              extraction_.corners().begin(), extraction_.corners().end(), [&](const Corner& found) {
                const Eigen::Vector2d error = found.estimate.position - truth;
                return error.dot(found.estimate.covariance.inverse() * error) < 18.42;
              });
        }));
  }

  /// The line nearest to this one lies at this distance from the sensor, to 5 standard deviations.
  void expect_line(double alpha, double r) const {
    for (const LineSegment& line : extraction_.lines()) {
      const double deviation = std::sqrt(line.estimate.alpha_r_covariance()(1, 1));
      if (std::abs(line.estimate.line.alpha - alpha) < 0.05 &&
          std::abs(line.estimate.line.r - r) < 5.0 * deviation && deviation < 0.01) {
        return;
      }
    }
    ADD_FAILURE() << "no line at " << r << " m";
  }

  World world_;
  ScannerSettings settings_;
  SensorModel noise_;
  Extraction extraction_;
};

TEST_P(RealScans, StrayReturnsCutNoWall) {
  world_.add_polyline(room, true);
  int corners = 0;
  int lines = 0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    Random random(seed);
    scan(seed, [&random](SimulatedScan& changed) {
      for (float& range : changed.ranges) {
        if (random.uniform() < 0.05) range = static_cast<float>(0.3 + random.uniform() * 1.0);
      }
    });
    corners += true_corners();
    lines += static_cast<int>(extraction_.lines().size());
    EXPECT_LE(extraction_.corners().size(), 4U) << seed;
  }
  EXPECT_GE(corners, 72);
  EXPECT_LE(lines, 96);
}

TEST_P(RealScans, ErrorCodesCutNoWall) {
  world_.add_polyline(room, true);
  settings_.range_min = 0.0;
  Random random(1);
  scan(1, [&random](SimulatedScan& changed) {
    for (float& range : changed.ranges) {
      if (random.uniform() < 0.1) range = 0.007F;
    }
  });
  EXPECT_EQ(extraction_.lines().size(), 4U);
  EXPECT_EQ(true_corners(), 4);
}

TEST_P(RealScans, AWallGoesOnBehindALeg) {
  world_.add_polyline(room, true);
  world_.pillars = {{{1.0, 1.2}, 0.02}, {{-1.2, -0.3}, 0.03}};
  std::size_t lines = 0;
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    scan(seed);
    lines += extraction_.lines().size();
    EXPECT_EQ(true_corners(), 4) << seed;
  }
  EXPECT_LE(lines, 42U);
}

TEST_P(RealScans, AWallDoesNotGoOnThroughAnOpening) {
  // A wall with an opening of 30 cm, and another wall behind.
  world_.walls = {
      {{2.0, -2.0}, {2.0, -0.15}}, {{2.0, 0.15}, {2.0, 2.0}}, {{4.0, -2.0}, {4.0, 2.0}}};
  scan(1);
  EXPECT_GE(extraction_.lines().size(), 2U);
  for (const LineSegment& line : extraction_.lines()) {
    EXPECT_FALSE(line.start.y() < -0.2 && line.end.y() > 0.2 && line.estimate.line.r < 3.0);
  }
}

TEST_P(RealScans, TheEndOfAWallIsNotAveragedIn) {
  noise_ = {0.003, 0.0009, 0.0};
  settings_.points = 1440;
  for (const double thickness : {0.04, 0.05}) {
    world_.walls = {{{0.68, 0.92}, {0.68, 1.72}}, {{0.68, 0.92}, {0.68 + thickness, 0.92}}};
    scan(2);
    expect_line(0.0, 0.68);
  }
}

TEST_P(RealScans, AStepMakesTwoWalls) {
  noise_ = {0.003, 0.0009, 0.0};
  settings_.points = 1440;
  for (const double step : {0.03, 0.05}) {
    world_.walls = {{{2.0, -3.0}, {2.0, 0.3}}, {{2.0 + step, 0.3}, {2.0 + step, 3.0}}};
    scan(3);
    expect_line(0.0, 2.0);
    expect_line(0.0, 2.0 + step);
  }
}

TEST_P(RealScans, RoundThingsHaveNoCorners) {
  std::size_t corners = 0;
  std::size_t arcs = 0;
  std::size_t scans = 0;
  for (const double radius : {0.1, 0.3, 0.6, 1.2}) {
    for (const double distance : {0.7, 2.0, 4.0}) {
      for (std::uint64_t seed = 0; seed < 5; ++seed) {
        world_.pillars = {{{distance + radius, 0.3 * radius}, radius}};
        scan(seed);
        corners += extraction_.corners().size();
        arcs += extraction_.arcs().size();
        ++scans;
      }
    }
  }
  EXPECT_LE(corners, 1U);
  // It gives no pieces that are not elongated.
  const bool wants_arcs = GetParam() != "hierarchical";
  EXPECT_GE(2 * arcs, wants_arcs ? scans : 0U);
}

TEST_P(RealScans, ARoundRoomHasNoCorners) {
  for (int i = 0; i < 720; ++i) {
    const double a = 2.0 * 3.14159265358979 * i / 720;
    const double b = 2.0 * 3.14159265358979 * (i + 1) / 720;
    world_.walls.push_back({{0.4 + 2.0 * std::cos(a), 0.2 + 2.0 * std::sin(a)},
                            {0.4 + 2.0 * std::cos(b), 0.2 + 2.0 * std::sin(b)}});
  }
  scan(1);
  EXPECT_EQ(extraction_.corners().size(), 0U);
  EXPECT_LE(extraction_.lines().size(), 2U);
}

TEST_P(RealScans, AFillValueIsNoWall) {
  world_.walls = {{{4.0, -6.0}, {4.0, 3.0}}, {{4.0, 3.0}, {-2.0, 3.0}}};
  scan(1, [](SimulatedScan& changed) {
    for (float& range : changed.ranges) {
      if (!std::isfinite(range)) range = 12.0F;
    }
  });
  EXPECT_EQ(extraction_.lines().size(), 2U);
  EXPECT_EQ(extraction_.corners().size(), 1U);
}

TEST_P(RealScans, FewRaysShowTheCornersOfARoom) {
  world_.add_polyline(room, true);
  for (const std::size_t rays : {std::size_t{120}, std::size_t{360}}) {
    settings_.points = rays;
    int corners = 0;
    for (std::uint64_t seed = 0; seed < 5; ++seed) {
      scan(seed);
      corners += true_corners();
    }
    EXPECT_GE(corners, 19) << rays;
  }
}

TEST_P(RealScans, MoreNoiseThanTheSensorModelSaysIsLearnt) {
  world_.add_polyline(room, true);
  settings_.noise = {0.03, 0.00197, 0.0};
  SimulatedScanner scanner(world_, settings_, 1);
  SimulatedScan scan;
  scanner.scan(0.0, 0.0, scan);
  extraction_.run(view(scan, settings_), noise_, noise_);
  EXPECT_EQ(extraction_.lines().size(), 4U);
  EXPECT_EQ(true_corners(), 4) << "the covariances are scaled";
}

INSTANTIATE_TEST_SUITE_P(All, RealScans, testing::ValuesIn(segmenter_names()),
                         [](const auto& method) { return method.param; });

}  // namespace
}  // namespace quoin
