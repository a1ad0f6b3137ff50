// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/calibration/variance_components.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <Eigen/Core>
#include <Eigen/LU>

#include "core/fitting/likelihood_fitters.hpp"
#include "core/geometry/angle.hpp"
#include "core/statistics/chi_square.hpp"
#include "core/statistics/order_statistics.hpp"

namespace quoin {
namespace {

constexpr std::size_t points_of_block = 8;

struct Part {
  Line line;
  Eigen::Matrix2d noise;
  Eigen::Matrix2d unevenness;
};

NormalLine normal_line_of(const Line& line) {
  const Eigen::Vector2d normal = line.normal();
  return {normal.x(), normal.y(), line.r};
}

/// The line of a part of a wall with its covariance about the middle of the whole.
std::optional<Part> part_of(const PointsView& points, const SensorModel& sensor,
                            const Eigen::Vector2d& middle) {
  const FitResult fit = InverseRange()(points, sensor);
  if (!fit.ok()) return std::nullopt;
  const NormalLine line = normal_line_of(fit.estimate.line);
  const std::size_t last = points.size() - 1;
  const double first_along = line.along(points.x[0], points.y[0]);
  const double last_along = line.along(points.x[last], points.y[last]);
  const double along = line.along(middle.x(), middle.y());
  const double length = std::abs(last_along - first_along);
  if (!(length > 0.0)) return std::nullopt;
  const LineEstimate unevenness{fit.estimate.line, flatness_covariance(1.0, length),
                                0.5 * (first_along + last_along)};
  return Part{fit.estimate.line, fit.estimate.about(along).covariance,
              unevenness.about(along).covariance};
}

std::optional<HalvesDifference> compare(const PointsView& first, const PointsView& second,
                                        const SensorModel& sensor, const Eigen::Vector2d& middle) {
  const auto a = part_of(first, sensor, middle);
  const auto b = part_of(second, sensor, middle);
  if (!a || !b) return std::nullopt;
  const double turn = normalized_angle(b->line.alpha - a->line.alpha);
  if (!(std::abs(turn) < 0.5 * pi)) return std::nullopt;
  const double offset = normal_line_of(a->line).distance(middle.x(), middle.y()) -
                        normal_line_of(b->line).distance(middle.x(), middle.y());
  return HalvesDifference{{turn, offset}, a->noise + b->noise, a->unevenness + b->unevenness};
}

/// The difference of odd and even rays, counted by the gaps between their bearings: rays without a
/// return have no point.
void compare_alternate(const PointsView& points, std::span<const double> residuals,
                       WallResiduals& wall) {
  const std::size_t count = residuals.size();
  std::vector<double> gaps;
  for (std::size_t i = 1; i < count; ++i) gaps.push_back(points.bearing[i] - points.bearing[i - 1]);
  const double step = median(gaps);
  if (!(step > 0.0)) return;
  std::array<double, 2> sums{};
  std::array<double, 2> counts{};
  double squares = 0.0;
  std::size_t ray = 0;
  for (std::size_t i = 0; i < count; ++i) {
    if (i > 0) ray += static_cast<std::size_t>(std::max(1.0, std::round(gaps[i - 1] / step)));
    sums.at(ray % 2) += residuals[i];
    counts.at(ray % 2) += 1.0;
    squares += residuals[i] * residuals[i];
  }
  if (counts[0] < 2.0 || counts[1] < 2.0) return;
  const double even = sums[0] / counts[0];
  const double odd = sums[1] / counts[1];
  const double within = squares - counts[0] * even * even - counts[1] * odd * odd;
  wall.alternation = odd - even;
  wall.alternation_noise =
      within / static_cast<double>(count - 3) * (1.0 / counts[0] + 1.0 / counts[1]);
}

}  // namespace

void ResidualTable::clear() {
  walls_.clear();
  blocks_.clear();
}

void ResidualTable::add(const PointsView& points, const SensorModel& sensor) {
  SensorModel white = sensor;
  white.flatness_stddev = 0.0;
  const FitResult fit = InverseRange()(points, white);
  if (!fit.ok()) return;
  const NormalLine line = normal_line_of(fit.estimate.line);
  const std::size_t count = points.size();

  WallResiduals wall;
  wall.points = static_cast<double>(count);
  wall.first_block = blocks_.size();
  wall.block_count = (count + points_of_block - 1) / points_of_block;
  residuals_.resize(count);
  double squares = 0.0;
  double products = 0.0;
  for (std::size_t b = 0; b < wall.block_count; ++b) {
    ResidualBlock block;
    const std::size_t begin = count * b / wall.block_count;
    const std::size_t end = count * (b + 1) / wall.block_count;
    for (std::size_t i = begin; i < end; ++i) {
      const double cosine = points.cosine[i] * line.normal_x + points.sine[i] * line.normal_y;
      const double along = line.along(points.x[i], points.y[i]);
      const double residual = points.range[i] * cosine - line.offset;
      block.factors[of_range] += cosine * cosine;
      block.factors[of_growth] += line.offset * line.offset;  // (r / cos * cos)^2
      block.factors[of_bearing] += along * along;
      block.squared += residual * residual;
      block.range += points.range[i];
      block.cosine += std::abs(cosine);
      residuals_[i] = residual;
      squares += residual * residual;
      if (i > 0) products += residual * residuals_[i - 1];
    }
    block.points = static_cast<double>(end - begin);
    for (double& factor : block.factors) factor /= block.points;
    block.range /= block.points;
    block.cosine /= block.points;
    blocks_.push_back(block);
  }
  if (squares > 0.0) wall.neighbours = products / squares;
  if (count >= fewest_points_of_halves) {
    compare_alternate(points, residuals_, wall);
    const Eigen::Vector2d middle(0.5 * (points.x.front() + points.x.back()),
                                 0.5 * (points.y.front() + points.y.back()));
    wall.halves =
        compare(points.subview(0, count / 2), points.subview(count / 2, count), white, middle);
  }
  walls_.push_back(wall);
}

namespace {

using Variances = Eigen::Vector3d;  // in the order of NoiseFactor
using Weights = Eigen::Matrix3d;

// Of the variance of the walls' own deviation, what that of a range is at least.
constexpr double least_range_share = 0.25;
constexpr double smallest_variance = 1e-10;  // [m^2] (10 um)^2: no range finder is better

Variances variances_of(const SensorModel& model) {
  return {model.range_stddev * model.range_stddev,
          model.range_stddev_per_metre * model.range_stddev_per_metre,
          model.bearing_stddev * model.bearing_stddev};
}

/// `flatness` [m^2] is the variance of a wall's own deviation from its line.
double variance_of(const ResidualBlock& block, const Variances& variances, double flatness) {
  double sum = flatness;
  for (std::size_t k = 0; k < noise_factor_count; ++k) {
    sum += block.factors[k] * variances[static_cast<Eigen::Index>(k)];
  }
  return std::max(sum, smallest_variance);
}

double chi_square(const ResidualTable& table, const WallResiduals& wall, const Variances& variances,
                  double flatness) {
  double sum = 0.0;
  for (const ResidualBlock& block : table.blocks(wall)) {
    sum += block.squared / variance_of(block, variances, flatness);
  }
  return sum;
}

/// The x >= 0 that minimizes x' A x / 2 - b' x, with the first of them positive: the best of the
/// minima on all faces of it. No sensor is without noise at the range 0, and walls that are all far
/// away could not tell its noise from one that grows.
Variances nonnegative_minimum(const Weights& a, const Variances& b) {
  Variances best = Variances::Zero();
  double lowest = 0.0;
  for (unsigned face = 1; face < 8; face += 2) {
    std::vector<Eigen::Index> free;
    for (Eigen::Index k = 0; k < 3; ++k) {
      if ((face >> static_cast<unsigned>(k) & 1U) != 0) free.push_back(k);
    }
    const Eigen::MatrixXd part = a(free, free);
    const Eigen::VectorXd right = b(free);
    const Eigen::FullPivLU<Eigen::MatrixXd> lu(part);
    if (!lu.isInvertible()) continue;
    const Eigen::VectorXd x = lu.solve(right);
    if (!x.allFinite() || !(x.minCoeff() >= 0.0)) continue;
    const double value = -0.5 * right.dot(x);
    if (value >= lowest) continue;
    lowest = value;
    best.setZero();
    for (std::size_t k = 0; k < free.size(); ++k) best[free[k]] = x[static_cast<Eigen::Index>(k)];
  }
  return best;
}

/// Variances under which the median wall has the chi square that it should have, whatever its
/// range and incidence: least absolute deviations, by reweighting. Half of the walls may be
/// anything without an effect that grows with how far off they are.
Variances ray_variances(const ResidualTable& table, std::span<const WallResiduals> walls,
                        Variances variances, double flatness) {
  constexpr int most_iterations = 100;
  constexpr double nearest = 0.05;  // deviations below it count alike, so that weights are finite
  constexpr double enough = 1e-5;
  Variances result = Variances::Zero();
  for (int iteration = 0; iteration < most_iterations && !walls.empty(); ++iteration) {
    // In units of the last estimate, or of what would explain all noise, the three are comparable.
    Weights information = Weights::Zero();
    Variances right = Variances::Zero();
    for (const WallResiduals& wall : walls) {
      const double freedom = wall.points - 2.0;
      const double expected = median_chi_square(freedom);
      const double relative = chi_square(table, wall, variances, flatness) / expected - 1.0;
      const double weight = 1.0 / (std::sqrt(freedom) * std::max(std::abs(relative), nearest));
      for (const ResidualBlock& block : table.blocks(wall)) {
        const double variance = variance_of(block, variances, flatness);
        const Variances factors(block.factors[0], block.factors[1], block.factors[2]);
        const double w = weight / (variance * variance);
        information += w * block.points * factors * factors.transpose();
        const double squared = wall.points / expected * block.squared;
        right += w * (squared - block.points * flatness) * factors;
      }
    }
    const Variances units = information.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
    const Weights scaled = units.asDiagonal() * information * units.asDiagonal();
    const Variances found =
        nonnegative_minimum(scaled, units.asDiagonal() * right).cwiseProduct(units);
    const double change = (found - variances).cwiseQuotient(units).norm();
    const double size = found.cwiseQuotient(units).norm();
    // Half of the way: reweighted by the inverse deviation, whole steps swing to and fro.
    variances = 0.5 * (variances + found);
    result = found;
    if (change < enough * size) break;
  }
  return result;
}

/// The standard deviation of what is added to the noise, so that the mean of `excess`, a function
/// of it that falls, is 0; 0 when it never is above.
template <class Excess>
double added_stddev(double largest, const Excess& excess) {
  constexpr int bisections = 40;
  if (!(excess(0.0) > 0.0)) return 0.0;
  double low = 0.0;
  double high = largest;
  for (int i = 0; i < bisections; ++i) {
    const double middle = 0.5 * (low + high);
    (excess(middle) > 0.0 ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

constexpr double largest_added = 1.0;  // [m]
// A squared distance with one degree of freedom counts up to where it should be exceeded once in
// 100 times, and its mean is then this.
constexpr double most_of_one = 6.6349;
constexpr double mean_of_one = 0.9819;

/// With it the 95 % ellipses of the halves of walls hold 95 % of their differences. What residuals
/// refute is scaled by them, as it is where lines are fitted: noisy walls are not uneven ones.
double flatness(const ResidualTable& table, std::span<const WallResiduals> walls,
                const SensorModel& model) {
  std::vector<double> scales;
  for (const WallResiduals& wall : walls) {
    scales.push_back(residual_scale(chi_square(table, wall, model), wall.points - 2.0));
  }
  return added_stddev(largest_added, [&](double stddev) {
    double excess = 0.0;
    for (std::size_t k = 0; k < walls.size(); ++k) {
      if (!walls[k].halves) continue;
      const HalvesDifference& halves = *walls[k].halves;
      const Eigen::Matrix2d covariance =
          scales[k] * halves.noise + stddev * stddev * halves.unevenness;
      const double squared = halves.difference.dot(covariance.inverse() * halves.difference);
      excess += squared > chi_square_2_95 ? 0.95 : -0.05;
    }
    return excess;
  });
}

double interlacing(std::span<const WallResiduals> walls) {
  return added_stddev(largest_added, [&](double stddev) {
    double excess = 0.0;
    for (const WallResiduals& wall : walls) {
      if (!(wall.alternation_noise > 0.0)) continue;
      const double variance = wall.alternation_noise + stddev * stddev;
      excess += std::min(wall.alternation * wall.alternation / variance, most_of_one) - mean_of_one;
    }
    return excess;
  });
}

double correlation(std::span<const WallResiduals> walls) {
  std::vector<double> values;
  for (const WallResiduals& wall : walls) {
    // Of white residuals about a line that was fitted to them it is about -3 / n.
    if (wall.halves) values.push_back(wall.neighbours + 3.0 / wall.points);
  }
  return median(std::move(values));
}

}  // namespace

double variance_of(const ResidualBlock& block, const SensorModel& model) {
  return variance_of(block, variances_of(model), model.flatness_stddev * model.flatness_stddev);
}

double chi_square(const ResidualTable& table, const WallResiduals& wall, const SensorModel& model) {
  return chi_square(table, wall, variances_of(model),
                    model.flatness_stddev * model.flatness_stddev);
}

NoiseComponents find_components(const ResidualTable& table, std::span<const WallResiduals> walls,
                                const SensorModel& start) {
  NoiseComponents components;
  components.flatness_stddev = flatness(table, walls, start);
  const double uneven = components.flatness_stddev * components.flatness_stddev;
  Variances variances = ray_variances(table, walls, variances_of(start), uneven);
  // Rays without noise would outweigh all others of their wall.
  variances[of_range] = std::max(variances[of_range], least_range_share * uneven);
  components.range_stddev = std::sqrt(variances[of_range]);
  components.range_stddev_per_metre = std::sqrt(variances[of_growth]);
  components.bearing_stddev = std::sqrt(variances[of_bearing]);
  components.interlace_stddev = interlacing(walls);
  components.neighbour_correlation = correlation(walls);
  return components;
}

}  // namespace quoin
