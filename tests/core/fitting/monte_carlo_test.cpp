// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <random>
#include <string>
#include <vector>

#include <Eigen/LU>

#include "core/geometry/corner.hpp"
#include "core/statistics/chi_square.hpp"
#include "tests/core/fitting/fitting_fixtures.hpp"
#include "tests/core/matchers.hpp"

namespace quoin {
namespace {

/// A room of 4.5 x 2.5 m, its walls scanned by 935 rays a revolution and every ray assigned to its
/// true wall.
struct Room {
  static constexpr double right = 2.4, top = 1.3, left = 2.1, bottom = 1.2;
  std::array<Line, 4> walls{{{0.0, right}, {pi / 2, top}, {pi, left}, {-pi / 2, bottom}}};
  std::array<Eigen::Vector2d, 4> corners{
      {{right, top}, {-left, top}, {-left, -bottom}, {right, -bottom}}};  ///< end of each wall

  [[nodiscard]] Points scan(std::size_t wall, const SensorModel& sensor,
                            std::mt19937_64& engine) const {
    const double step = 2.0 * pi / 935.0;
    const Eigen::Vector2d& from = corners[(wall + 3) % 4];
    const Eigen::Vector2d& to = corners[wall];
    const double first = std::atan2(from.y(), from.x());
    const double width = normalized_angle(std::atan2(to.y(), to.x()) - first);
    return wall_points(walls[wall], first + 0.5 * step, first + width - 0.5 * step,
                       static_cast<std::size_t>(width / step), sensor, engine);
  }
};

/// What came of one fitter.
struct Outcome {
  double nees = 0.0;          ///< mean normalised squared error of the corners; 2 when consistent
  double coverage = 0.0;      ///< of the corners by their 95 % ellipses
  double over_bound = 0.0;    ///< RMSE of alpha and r over the Cramer-Rao bound, median of 4 walls
  double scatter_nees = 0.0;  ///< of the lines about their own mean instead of the truth
};

class Trials {
 public:
  void add(const Room& room, const std::array<LineEstimate, 4>& lines) {
    for (std::size_t k = 0; k < 4; ++k) {
      const auto corner = intersect(lines[k], lines[(k + 1) % 4]);
      ASSERT_TRUE(corner);
      const Eigen::Vector2d error = corner->position - room.corners[k];
      const double squared = error.dot(corner->covariance.inverse() * error);
      nees_ += squared;
      inside_ += squared <= chi_square_2_95 ? 1.0 : 0.0;
      const Line& line = lines[k].line;
      const Line& truth = room.walls[k];
      errors_[k].emplace_back(normalized_angle(line.alpha - truth.alpha), line.r - truth.r);
      information_[k].push_back(lines[k].covariance.inverse());
    }
  }

  [[nodiscard]] Outcome outcome(const std::array<Eigen::Matrix2d, 4>& bounds) const {
    const auto trials = static_cast<double>(errors_[0].size());
    Outcome result;
    result.nees = nees_ / (4.0 * trials);
    result.coverage = inside_ / (4.0 * trials);
    std::vector<double> ratios;
    for (std::size_t k = 0; k < 4; ++k) {
      Eigen::Vector2d mean = Eigen::Vector2d::Zero();
      Eigen::Vector2d squares = Eigen::Vector2d::Zero();
      for (const Eigen::Vector2d& e : errors_[k]) {
        mean += e / trials;
        squares += e.cwiseProduct(e) / trials;
      }
      for (std::size_t i = 0; i < errors_[k].size(); ++i) {
        const Eigen::Vector2d e = errors_[k][i] - mean;
        result.scatter_nees += e.dot(information_[k][i] * e) / (4.0 * trials);
      }
      ratios.push_back(std::sqrt(squares(0) / bounds[k](0, 0)));
      ratios.push_back(std::sqrt(squares(1) / bounds[k](1, 1)));
    }
    std::sort(ratios.begin(), ratios.end());
    result.over_bound = 0.5 * (ratios[3] + ratios[4]);
    return result;
  }

 private:
  double nees_ = 0.0;
  double inside_ = 0.0;
  std::array<std::vector<Eigen::Vector2d>, 4> errors_;
  std::array<std::vector<Eigen::Matrix2d>, 4> information_;
};

/// All fitters on the same scans.
std::map<std::string, Outcome> outcomes(const SensorModel& sensor, const char* covariance,
                                        int trials) {
  const Room room;
  std::mt19937_64 engine(2026);
  std::array<Eigen::Matrix2d, 4> bounds;
  for (std::size_t k = 0; k < 4; ++k) {
    const Points exact = room.scan(k, {0.0, 0.0, 0.0}, engine);
    bounds[k] = cramer_rao_bound(room.walls[k], exact.bearing, sensor);
  }
  std::map<std::string, Trials> all;
  std::map<std::string, Fitter> fitters;
  for (const std::string& name : fitter_names()) fitters[name] = make_fitter(name, covariance);
  for (int trial = 0; trial < trials; ++trial) {
    std::array<Points, 4> scans;
    for (std::size_t k = 0; k < 4; ++k) scans[k] = room.scan(k, sensor, engine);
    for (const auto& [name, fitter] : fitters) {
      std::array<LineEstimate, 4> lines;
      for (std::size_t k = 0; k < 4; ++k) lines[k] = fitter(scans[k], sensor).estimate;
      all[name].add(room, lines);
    }
  }
  std::map<std::string, Outcome> result;
  for (const auto& [name, outcome] : all) result[name] = outcome.outcome(bounds);
  return result;
}

const SensorModel coarse{0.05, 0.391 * pi / 180.0, 0.0};
const SensorModel fine{0.01, 0.113 * pi / 180.0, 0.0};
const SensorModel growing{0.002, 0.113 * pi / 180.0, 0.0, 0.01};

// 6000 revolutions give 24000 corners and as many lines. Standard deviations: 0.013 for the mean of
// a chi-square with two degrees of freedom over independent lines, 0.14 % for a coverage of 95 %;
// corners share lines with their neighbours, which makes it up to 0.02 and 0.2 %.
constexpr int revolutions = 6000;

TEST(MonteCarlo, PropagatedCovariancesPredictTheScatter) {
  for (const SensorModel& sensor : {coarse, fine, growing}) {
    for (const auto& [name, outcome] : outcomes(sensor, "propagated", revolutions)) {
      SCOPED_TRACE(name);
      EXPECT_NEAR(outcome.scatter_nees, 2.0, 0.05);
      if (is_efficient(name)) {
        EXPECT_NEAR(outcome.nees, 2.0, 0.06);
        EXPECT_NEAR(outcome.coverage, 0.95, 0.005);
        // The median of eight ratios, each with a standard deviation of 1 / sqrt(2 * 6000).
        EXPECT_NEAR(outcome.over_bound, 1.0, 0.02);
      } else {
        // No unbiased fit beats the bound; the biases must not show at a range noise of 10 mm.
        EXPECT_GT(outcome.over_bound, 0.98);
        if (sensor.range_stddev < 0.02) {
          EXPECT_NEAR(outcome.nees, 2.0, 0.06);
          EXPECT_NEAR(outcome.coverage, 0.95, 0.006);
        }
      }
    }
  }
}

TEST(MonteCarlo, BiasShowsWhereTheNoiseIsLarge) {
  const auto all = outcomes(coarse, "propagated", 1500);
  // The mean of 1 / range: a bias of sr^2 / range, about 1.4 mm at 1.3 m against 3.3 mm of scatter.
  for (const char* name : {"utls", "wtls", "wctls"}) {
    EXPECT_NEAR(all.at(name).nees, 2.0, 0.16) << name;
    EXPECT_NEAR(all.at(name).coverage, 0.95, 0.013) << name;
  }
  // Noise of the abscissa, noise not across the line, weights that follow the noise of the range.
  EXPECT_GT(all.at("cwlf").nees, 2.1);
  EXPECT_GT(all.at("arras_siegwart").nees, 2.1);
}

TEST(MonteCarlo, PublishedCovariancesAreNotThoseOfTheScatter) {
  const auto all = outcomes(fine, "as_published", 1500);
  // One error common to all rays instead of averaged ones.
  EXPECT_LT(all.at("utls").nees, 0.8);
  EXPECT_LT(all.at("wtls").nees, 0.8);
  // Conditional variances are smaller than those of the residuals.
  EXPECT_GT(all.at("cwlf").scatter_nees, 3.0);
  // Without the bearing noise, which is small across these walls.
  EXPECT_GT(all.at("arras_siegwart").scatter_nees, 2.0);
  // The scale of the residuals is right, but their variance is not the same along a wall.
  EXPECT_NEAR(all.at("pca").scatter_nees, 2.0, 0.4);
  EXPECT_NEAR(all.at("least_squares").scatter_nees, 2.0, 0.4);
  // Nothing else is published.
  for (const char* name : {"wctls", "maximum_likelihood", "inverse_range"}) {
    EXPECT_NEAR(all.at(name).scatter_nees, 2.0, 0.1) << name;
  }
}

}  // namespace
}  // namespace quoin
