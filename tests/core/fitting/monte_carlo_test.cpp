// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include <Eigen/LU>

#include "core/fitting/fitters.hpp"
#include "core/geometry/corner.hpp"
#include "tests/core/matchers.hpp"
#include "tests/core/wall_points.hpp"

namespace quoin {
namespace {

/// Mean normalised squared error (should be 2) and coverage of the 95 % ellipse of the corners of a
/// 4.5 x 2.5 m room, points assigned to their true walls.
struct Consistency {
  double nees = 0.0;
  double coverage = 0.0;
};

Consistency consistency(const Fitter& fitter) {
  const SensorModel sensor{0.05, 0.391 * pi / 180.0, 0.0};
  const double right = 2.4, top = 1.3, left = 2.1, bottom = 1.2;
  const std::vector<Line> walls{{0.0, right}, {pi / 2, top}, {pi, left}, {-pi / 2, bottom}};
  const std::vector<Eigen::Vector2d> corners{
      {right, top}, {-left, top}, {-left, -bottom}, {right, -bottom}};
  const double step = 2.0 * pi / 935.0;
  std::mt19937_64 engine(2026);
  const int trials = 1500;
  double nees = 0.0;
  int inside = 0;
  for (int trial = 0; trial < trials; ++trial) {
    std::vector<LineEstimate> lines;
    for (std::size_t k = 0; k < 4; ++k) {
      const Eigen::Vector2d& from = corners[(k + 3) % 4];
      const Eigen::Vector2d& to = corners[k];
      const double first = std::atan2(from.y(), from.x());
      const double width = normalized_angle(std::atan2(to.y(), to.x()) - first);
      const auto count = static_cast<std::size_t>(width / step);
      const Points p = wall_points(walls[k], first + 0.5 * step, first + width - 0.5 * step, count,
                                   sensor, engine);
      lines.push_back(fitter(p, sensor).estimate);
    }
    for (std::size_t k = 0; k < 4; ++k) {
      const auto corner = intersect(lines[k], lines[(k + 1) % 4]);
      const Eigen::Vector2d error = corner->position - corners[k];
      const double squared = error.dot(corner->covariance.inverse() * error);
      nees += squared;
      inside += squared <= chi_square_2_95 ? 1 : 0;
    }
  }
  return {nees / (4.0 * trials), inside / (4.0 * trials)};
}

// 6000 corners, neighbours correlated: standard deviations of at most 0.04 and 0.5 %.
TEST(MonteCarlo, PropagatedCovariancesAreConsistent) {
  for (const char* name : {"utls", "wtls", "wctls"}) {
    const Consistency c = consistency(Fitters::make<Fitter>(name, {}));
    EXPECT_NEAR(c.nees, 2.0, 0.14) << name;
    EXPECT_NEAR(c.coverage, 0.95, 0.013) << name;
  }
}

TEST(MonteCarlo, PublishedReadingIsFarTooLarge) {
  for (const char* name : {"utls", "wtls"}) {
    const Consistency c =
        consistency(Fitters::make<Fitter>(name, {{"covariance", "as_published"}}));
    EXPECT_LT(c.nees, 0.8) << name;
    EXPECT_GT(c.coverage, 0.985) << name;
  }
}

}  // namespace
}  // namespace quoin
