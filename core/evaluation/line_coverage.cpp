// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/evaluation/line_coverage.hpp"

#include <cmath>

#include <Eigen/LU>

#include "core/evaluation/scene.hpp"
#include "core/fitting/line_difference.hpp"
#include "core/geometry/angle.hpp"
#include "core/geometry/corner.hpp"
#include "core/simulation/random.hpp"
#include "core/statistics/chi_square.hpp"

namespace quoin {
namespace {

bool is_inside(const Eigen::Vector2d& error, const Eigen::Matrix2d& covariance) {
  return error.dot(covariance.inverse() * error) <= chi_square_2_95;
}

}  // namespace

LineCoverage judge_wall(const Fitter& fitter, const SingleWall& wall, const SensorModel& noise,
                        std::size_t rays, std::size_t fewest_points, std::size_t trials,
                        std::uint64_t seed) {
  // The mid-point is on the x axis.
  const Line truth{wall.incidence, wall.distance * std::cos(wall.incidence)};
  const Eigen::Vector2d half =
      0.5 * wall.length * Eigen::Vector2d(-std::sin(wall.incidence), std::cos(wall.incidence));
  const Eigen::Vector2d first = Eigen::Vector2d(wall.distance, 0.0) - half;
  const Eigen::Vector2d last = Eigen::Vector2d(wall.distance, 0.0) + half;
  const double begin = std::atan2(first.y(), first.x());
  const double end = std::atan2(last.y(), last.x());
  const double step = 2.0 * pi / static_cast<double>(rays);

  LineCoverage result;
  Random random(seed);
  VisibleWall seen;
  Points points;
  std::size_t measured = 0, sum_of_points = 0, inside = 0, gaussian = 0, inside_alpha_r = 0;
  for (std::size_t trial = 0; trial < trials; ++trial) {
    seen.bearings.clear();
    seen.ranges.clear();
    for (double bearing = begin + random.uniform() * step; bearing < end; bearing += step) {
      seen.bearings.push_back(bearing);
      seen.ranges.push_back(truth.r / std::cos(bearing - truth.alpha));
    }
    if (seen.bearings.size() < fewest_points) {
      ++result.few_rays;
      continue;
    }
    measure(seen, noise, random, points);
    ++measured;
    sum_of_points += points.size();
    const FitResult fit = fitter(points, noise);
    if (!fit.ok()) continue;
    ++result.trials;
    const LineSegment line = line_segment(fit.estimate, fit.normal, points);
    inside += squared_error(line, truth) <= chi_square_2_95 ? 1 : 0;
    if (!line.estimate.is_gaussian_in_alpha_r()) continue;
    ++gaussian;
    const Eigen::Vector2d error(normalized_angle(line.estimate.line.alpha - truth.alpha),
                                line.estimate.line.r - truth.r);
    inside_alpha_r += is_inside(error, line.estimate.alpha_r_covariance()) ? 1 : 0;
  }
  if (result.trials == 0) return result;
  result.points = static_cast<double>(sum_of_points) / static_cast<double>(measured);
  result.middle = proportion(inside, result.trials);
  result.alpha_r = proportion(inside_alpha_r, gaussian);
  result.gaussian = static_cast<double>(gaussian) / static_cast<double>(result.trials);
  return result;
}

}  // namespace quoin
