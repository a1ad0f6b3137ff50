// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/evaluation/consistency.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/LU>

#include "core/geometry/corner.hpp"
#include "core/statistics/chi_square.hpp"
#include "core/statistics/order_statistics.hpp"

namespace quoin {
namespace {

constexpr std::size_t batch_count = 20;  // enough to know a spread to a sixth of itself

struct CornerSums {
  MeanSums nees;
  std::size_t covered = 0;
  double squared_error = 0.0;  // [m^2]
  Eigen::Vector2d error = Eigen::Vector2d::Zero();
  std::array<MeanSums, batch_count> batches;  // of the squared error [m^2]
};

/// Root of the mean squared distance [m] at the bound, for each corner.
std::vector<double> corner_bounds(const Scene& scene, const SensorModel& noise) {
  std::vector<LineEstimate> lines;
  Random unused(0);
  Points points;
  for (const VisibleWall& wall : scene.walls) {
    measure(wall, {0.0, 0.0, 0.0}, unused, points);
    lines.push_back({wall.line, cramer_rao_bound(wall.line, points, noise)});
  }
  std::vector<double> bounds;
  for (const VisibleCorner& corner : scene.corners) {
    const auto estimate = intersect(lines[corner.first], lines[corner.second]);
    bounds.push_back(estimate ? std::sqrt(estimate->covariance.trace()) : 0.0);
  }
  return bounds;
}

/// Median over the corners of the root mean squared error over its bound, with the spread of the
/// same in batches of trials; without a spread when some batch has no trial.
Interval rmse_over_bound(const std::vector<CornerSums>& corners,
                         const std::vector<double>& bounds) {
  std::vector<double> ratios;
  std::array<std::vector<double>, batch_count> batches;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const std::size_t count = corners[k].nees.count;
    if (count == 0 || !(bounds[k] > 0.0)) continue;
    ratios.push_back(std::sqrt(corners[k].squared_error / static_cast<double>(count)) / bounds[k]);
    for (std::size_t b = 0; b < batch_count; ++b) {
      const MeanSums& sums = corners[k].batches[b];
      if (sums.count > 0) batches[b].push_back(std::sqrt(sums.mean().value) / bounds[k]);
    }
  }
  const double value = median(std::move(ratios));
  MeanSums spread;
  for (std::vector<double>& batch : batches) {
    if (batch.empty()) return {value, value, value};
    spread.add(median(std::move(batch)));
  }
  const Interval around = spread.mean();
  // Small batches make the root of a mean a little too small: the spread is theirs, the middle not.
  const double half = 0.5 * (around.high - around.low);
  return {value, value - half, value + half};
}

}  // namespace

Eigen::Matrix2d cramer_rao_bound(const Line& line, const PointsView& points,
                                 const SensorModel& noise) {
  const Eigen::Vector2d normal = line.normal();
  Eigen::Matrix2d information = Eigen::Matrix2d::Zero();
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double cos_phi = points.cosine[i] * normal.x() + points.sine[i] * normal.y();
    const double sin_phi = points.sine[i] * normal.x() - points.cosine[i] * normal.y();
    const double along = points.range[i] * sin_phi;
    const double tangential_noise = noise.bearing_stddev * along;
    const double weight = 1.0 / (noise.range_variance(points.range[i]) * cos_phi * cos_phi +
                                 tangential_noise * tangential_noise);
    const Eigen::Vector2d gradient(-along, 1.0);
    information += weight * gradient * gradient.transpose();
  }
  return information.inverse();
}

Consistency judge_consistency(const Fitter& fitter, const Scene& scene, const SensorModel& noise,
                              std::size_t trials, std::uint64_t seed) {
  Consistency result;
  result.trials = trials;
  Random random(seed);
  Points points;
  std::vector<FitResult> lines(scene.walls.size());
  std::vector<CornerSums> corners(scene.corners.size());
  MeanSums nees;  // means of a trial: its corners share lines and are not independent
  MeanSums coverage;
  for (std::size_t trial = 0; trial < trials; ++trial) {
    for (std::size_t k = 0; k < scene.walls.size(); ++k) {
      measure(scene.walls[k], noise, random, points);
      lines[k] = fitter(points, noise);
      ++result.failures[static_cast<std::size_t>(lines[k].failure)];
    }
    double trial_nees = 0.0;
    std::size_t trial_covered = 0;
    std::size_t trial_corners = 0;
    for (std::size_t k = 0; k < scene.corners.size(); ++k) {
      const FitResult& first = lines[scene.corners[k].first];
      const FitResult& second = lines[scene.corners[k].second];
      if (!first.ok() || !second.ok()) continue;
      const auto estimate = intersect(first.estimate, second.estimate);
      if (!estimate) continue;
      const Eigen::Vector2d error = estimate->position - scene.corners[k].position;
      const double squared = error.dot(estimate->covariance.inverse() * error);
      if (!std::isfinite(squared)) continue;
      const bool covered = squared <= chi_square_2_95;
      corners[k].nees.add(squared);
      corners[k].covered += covered ? 1 : 0;
      corners[k].squared_error += error.squaredNorm();
      corners[k].batches[trial % batch_count].add(error.squaredNorm());
      corners[k].error += error;
      trial_nees += squared;
      trial_covered += covered ? 1 : 0;
      ++trial_corners;
    }
    if (trial_corners == 0) continue;
    nees.add(trial_nees / static_cast<double>(trial_corners));
    coverage.add(static_cast<double>(trial_covered) / static_cast<double>(trial_corners));
  }

  result.nees = nees.mean();
  result.coverage95 = coverage.mean();
  const std::vector<double> bounds = corner_bounds(scene, noise);
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const CornerSums& sums = corners[k];
    if (sums.nees.count == 0) continue;
    const auto count = static_cast<double>(sums.nees.count);
    CornerConsistency corner;
    corner.position = scene.corners[k].position;
    corner.trials = sums.nees.count;
    corner.nees = sums.nees.mean();
    corner.coverage95 = proportion(sums.covered, corner.trials);
    corner.rmse = std::sqrt(sums.squared_error / count);
    corner.bound = bounds[k];
    corner.bias = sums.error / count;
    const double standard_error = std::sqrt(0.95 * 0.05 / count);
    result.worst_corner =
        std::max(result.worst_corner, std::abs(corner.coverage95.value - 0.95) / standard_error);
    result.corners.push_back(corner);
  }
  result.rmse_over_crb_interval = rmse_over_bound(corners, bounds);
  result.rmse_over_crb = result.rmse_over_crb_interval.value;
  return result;
}

}  // namespace quoin
