// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/calibration/wall_residuals.hpp"

#include <algorithm>
#include <cmath>

#include "core/fitting/inverse_range.hpp"
#include "core/geometry/angle.hpp"
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

}  // namespace quoin
