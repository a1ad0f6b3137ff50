// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/evaluation/circle_consistency.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/LU>

#include "core/geometry/angle.hpp"
#include "core/geometry/corner.hpp"
#include "core/statistics/chi_square.hpp"

namespace quoin {
namespace {

constexpr std::size_t spread_batches = 20;  // enough to know a spread to a sixth of itself

/// Of an error and of its bound; the ratio of their roots is wanted.
struct SquareSums {
  double error = 0.0;
  double bound = 0.0;

  void add(double squared_error, double variance) {
    error += squared_error;
    bound += variance;
  }
  [[nodiscard]] double ratio() const { return std::sqrt(error / bound); }
};

struct RmseOverBound {
  SquareSums all;
  std::array<SquareSums, spread_batches> batches;

  void add(std::size_t trial, double squared_error, double variance) {
    all.add(squared_error, variance);
    batches[trial % spread_batches].add(squared_error, variance);
  }
  [[nodiscard]] Interval interval() const {
    if (!(all.bound > 0.0)) return {};
    MeanSums spread;
    for (const SquareSums& batch : batches) {
      if (batch.bound > 0.0) spread.add(batch.ratio());
    }
    const Interval around = spread.mean();
    const double half = 0.5 * (around.high - around.low);
    return {all.ratio(), all.ratio() - half, all.ratio() + half};
  }
};

struct RayVariances {
  double across;  // [m^2] of the distance from the circle
  double along;   // [m^2]
};

RayVariances variances_at(double cosine, double sine, double range, const SensorModel& noise) {
  const double radial = noise.range_variance(range);
  const double turned = range * noise.bearing_stddev * range * noise.bearing_stddev;
  return {radial * cosine * cosine + turned * sine * sine,
          radial * sine * sine + turned * cosine * cosine};
}

}  // namespace

void observe(const ArcScene& scene, double direction, double phase, Points& points) {
  points.range.clear();
  points.bearing.clear();
  const double step = 2.0 * pi / static_cast<double>(scene.rays);
  for (std::size_t i = 0; i < scene.rays; ++i) {
    const double off = -pi + (static_cast<double>(i) + phase) * step;
    if (std::abs(off) > 0.5 * scene.field) continue;
    const double across = scene.distance * std::sin(off);
    const double square = scene.radius * scene.radius - across * across;
    if (!(square > 0.0)) continue;
    const double to_middle = scene.distance * std::cos(off);
    const double range =
        scene.concave() ? to_middle + std::sqrt(square) : to_middle - std::sqrt(square);
    if (!(range > 0.0)) continue;
    points.range.push_back(range);
    points.bearing.push_back(direction + off);
  }
  points.resize(points.range.size());
  compute_cartesian(points);
}

Eigen::Matrix3d cramer_rao_bound(const Circle& circle, const PointsView& points,
                                 const SensorModel& noise) {
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector2d normal =
        (Eigen::Vector2d(points.x[i], points.y[i]) - circle.center).normalized();
    const double cosine = normal.x() * points.cosine[i] + normal.y() * points.sine[i];
    const double sine = normal.x() * points.sine[i] - normal.y() * points.cosine[i];
    const Eigen::Vector3d gradient(normal.x(), normal.y(), 1.0);
    information +=
        gradient * gradient.transpose() / variances_at(cosine, sine, points.range[i], noise).across;
  }
  return information.inverse();
}

CircleConsistency judge_circle_consistency(const CircleFitter& fitter, const ArcScene& scene,
                                           const SensorModel& noise, std::size_t trials,
                                           std::uint64_t seed) {
  CircleConsistency result;
  result.trials = trials;
  Random random(seed);
  Points points;
  MeanSums nees;
  std::size_t covered = 0;
  std::size_t center_covered = 0;
  RmseOverBound center;
  RmseOverBound radius;
  double along = 0.0;  // variance of a point along the circle [m^2]
  double radius_variance = 0.0;
  for (std::size_t trial = 0; trial < trials; ++trial) {
    const double direction = random.uniform(-pi, pi);
    observe(scene, direction, random.uniform(), points);
    result.points += static_cast<double>(points.size()) / static_cast<double>(trials);
    if (points.size() < 3) {
      ++result.failures[static_cast<std::size_t>(CircleFailure::too_few_points)];
      continue;
    }
    const Circle truth{scene.distance * Eigen::Vector2d(std::cos(direction), std::sin(direction)),
                       scene.radius};
    const Eigen::Matrix3d bound = cramer_rao_bound(truth, points, noise);
    radius_variance += bound(2, 2) / static_cast<double>(trials);
    double sum = 0.0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const double nx = (points.x[i] - truth.center.x()) / truth.radius;
      const double ny = (points.y[i] - truth.center.y()) / truth.radius;
      sum += variances_at(nx * points.cosine[i] + ny * points.sine[i],
                          nx * points.sine[i] - ny * points.cosine[i], points.range[i], noise)
                 .along;
      // In the order of the rays, so that all fitters get the same.
      points.range[i] += std::sqrt(noise.range_variance(points.range[i])) * random.normal();
      points.bearing[i] += noise.bearing_stddev * random.normal();
    }
    along += sum / static_cast<double>(points.size()) / static_cast<double>(trials);
    compute_cartesian(points);
    const CircleFit fit = fitter(points, noise);
    ++result.failures[static_cast<std::size_t>(fit.failure)];
    if (!fit.ok()) continue;
    Eigen::Vector3d error;
    error << fit.estimate.circle.center - truth.center, fit.estimate.circle.radius - truth.radius;
    const Eigen::Matrix3d& covariance = fit.estimate.covariance;
    const double squared = error.dot(covariance.inverse() * error);
    const Eigen::Vector2d off = error.head<2>();
    const double squared_center = off.dot(covariance.topLeftCorner<2, 2>().inverse() * off);
    nees.add(squared);
    covered += squared <= chi_square_3_95 ? 1 : 0;
    center_covered += squared_center <= chi_square_2_95 ? 1 : 0;
    center.add(trial, off.squaredNorm(), bound.topLeftCorner<2, 2>().trace());
    radius.add(trial, error.z() * error.z(), bound(2, 2));
  }
  result.nonlinearity = std::sqrt(std::max(radius_variance, along)) / scene.radius;
  result.nees = nees.mean();
  result.coverage95 = proportion(covered, nees.count);
  result.coverage95_center = proportion(center_covered, nees.count);
  result.rmse_over_crb = center.interval();
  result.radius_rmse_over_crb = radius.interval();
  return result;
}

}  // namespace quoin
