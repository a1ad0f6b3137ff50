// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/evaluation/scan_consistency.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include "core/fitting/line_difference.hpp"
#include "core/geometry/angle.hpp"
#include "core/geometry/corner.hpp"
#include "core/statistics/chi_square.hpp"
#include "core/statistics/order_statistics.hpp"

namespace quoin {
namespace {

constexpr std::size_t stretches = 20;  // of a file, for intervals
constexpr std::size_t quantile_count = 200;

constexpr double rest_distance = 1e-3;                   // [m]
constexpr double rest_angle = 0.05 * pi / 180.0;         // [rad]
constexpr double perhaps_rest_distance = 0.02;           // [m]
constexpr double perhaps_rest_angle = 0.5 * pi / 180.0;  // [rad]
constexpr double same_wall_angle = 3.0 * pi / 180.0;     // [rad]
constexpr double same_wall_distance = 0.1;               // [m] of the middle, across
constexpr double same_wall_ends = 0.15;                  // [m]
constexpr std::size_t fewest_walls_for_motion = 3;
constexpr double one_in_100 = 2.326347874040841;  // quantile of the standard normal distribution

constexpr std::size_t index_of(SplitTest test) { return static_cast<std::size_t>(test); }

/// Whether the ratio of two reduced chi-squares of 3 and `freedom` degrees of freedom is larger
/// than chance makes it once in 100 times (normal approximation of the F distribution, Paulson
/// 1942).
bool significant(double ratio, double freedom) {
  const double first = 2.0 / (9.0 * 3.0);
  const double second = 2.0 / (9.0 * freedom);
  const double root = std::cbrt(ratio);
  const double normal =
      ((1.0 - second) * root - (1.0 - first)) / std::sqrt(second * root * root + first);
  return !(normal <= one_in_100);
}

/// The stretch of the file that a scan is in.
std::size_t stretch_of(std::size_t scan, std::size_t scans) {
  return scan * std::min(stretches, scans) / std::max<std::size_t>(scans, 1);
}

}  // namespace

ScanConsistency::ScanConsistency(Fitter fitter, const SensorModel& sensor)
    : fitter_(std::move(fitter)), sensor_(sensor), flat_(sensor) {
  flat_.flatness_stddev = 0.0;
}

std::optional<ScanConsistency::Fitted> ScanConsistency::fit(const PointsView& points,
                                                            const SensorModel& sensor) const {
  const FitResult result = fitter_(points, sensor);
  if (!result.ok()) return std::nullopt;
  Fitted fitted{line_segment(result.estimate, result.normal, points), {}, {}};
  add_flatness(fitted.line, sensor.flatness_stddev);
  fitted.middle = 0.5 * (fitted.line.start + fitted.line.end);
  const double residuals = chi_square(result.estimate.line, points, sensor);
  fitted.reported = true_segment(result, points, sensor, residuals).estimate;
  return fitted;
}

void ScanConsistency::compare(SplitTest test, const Fitted& first, const Fitted& second,
                              const Eigen::Vector2d& point) {
  const double modelled =
      LineDifference(first.line.estimate, second.line.estimate, point).mahalanobis_squared();
  const double reported =
      LineDifference(first.reported, second.reported, point).mahalanobis_squared();
  if (!std::isfinite(modelled) || !std::isfinite(reported)) return;
  modelled_[index_of(test)].push_back({scans_, modelled});
  reported_[index_of(test)].push_back({scans_, reported});
}

void ScanConsistency::add(const Extraction& extraction, const std::optional<Pose2>& pose) {
  std::vector<Fitted> lines;
  for (const Segment& segment : extraction.segments()) {
    const PointsView points = extraction.points().view().subview(segment.begin, segment.end);
    if (points.size() < 3) continue;
    const auto whole = fit(points, flat_);
    if (!whole) continue;
    const double squares = chi_square(whole->line.estimate.line, points, sensor_);
    if (std::isfinite(squares)) {
      residuals_.push_back({scans_, squares, static_cast<double>(points.size() - 2)});
    }
    if (points.size() < fewest_compared_points) continue;
    lines.push_back(*whole);

    take_every_other(points, 0, part_);
    const auto even = fit(part_, flat_);
    take_every_other(points, 1, part_);
    const auto odd = fit(part_, flat_);
    if (even && odd) compare(SplitTest::odd_even, *even, *odd, whole->middle);

    const std::size_t half = points.size() / 2;
    const auto front = fit(points.subview(0, half), sensor_);
    const auto back = fit(points.subview(points.size() - half, points.size()), sensor_);
    if (front && back) compare(SplitTest::halves, *front, *back, whole->middle);
  }
  if (scans_ > 0) {
    const bool known = pose && last_pose_;
    const auto within = [&](double distance, double angle) {
      return std::hypot(pose->x - last_pose_->x, pose->y - last_pose_->y) <= distance &&
             std::abs(normalized_angle(pose->theta - last_pose_->theta)) <= angle;
    };
    const bool at_rest = known && within(rest_distance, rest_angle);
    // Poses that come from matching scans are not steady when the sensor is.
    if (!known || within(perhaps_rest_distance, perhaps_rest_angle)) {
      compare_with_last(lines, at_rest);
    }
  }
  last_ = std::move(lines);
  last_pose_ = pose;
  ++scans_;
}

void ScanConsistency::compare_with_last(const std::vector<Fitted>& lines, bool known_at_rest) {
  std::vector<std::pair<const Fitted*, const Fitted*>> pairs;
  for (const Fitted& line : lines) {
    for (const Fitted& before : last_) {
      const LineDifference at(line.line.estimate, before.line.estimate, line.middle);
      if (std::abs(at.difference.x()) > same_wall_angle ||
          std::abs(at.difference.y()) > same_wall_distance ||
          (line.line.start - before.line.start).norm() > same_wall_ends ||
          (line.line.end - before.line.end).norm() > same_wall_ends) {
        continue;
      }
      pairs.emplace_back(&line, &before);
      break;
    }
  }
  if (!known_at_rest) {
    if (pairs.size() < fewest_walls_for_motion) return;
    // Least squares for the turn and the shift that all walls would share.
    Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
    Eigen::Vector3d vector = Eigen::Vector3d::Zero();
    double total = 0.0;
    for (const auto& [line, before] : pairs) {
      const LineDifference at(line->line.estimate, before->line.estimate, line->middle);
      const Eigen::Vector2d normal = line->line.estimate.line.normal();
      const double along = normal.x() * line->middle.y() - normal.y() * line->middle.x();
      Eigen::Matrix<double, 2, 3> jacobian;
      jacobian << 1.0, 0.0, 0.0, -along, normal.x(), normal.y();
      const Eigen::Matrix2d weight = at.covariance.inverse();
      information += jacobian.transpose() * weight * jacobian;
      vector += jacobian.transpose() * weight * at.difference;
      total += at.difference.dot(weight * at.difference);
    }
    const double explained = vector.dot(information.ldlt().solve(vector));
    const double freedom = 2.0 * static_cast<double>(pairs.size()) - 3.0;
    const double residual = std::max(total - explained, 0.0) / freedom;
    // Where noise is larger than modelled, so is what it looks like in motion.
    if (significant(explained / 3.0 / residual, freedom)) return;
  }
  ++at_rest_;
  for (const auto& [line, before] : pairs) {
    compare(SplitTest::at_rest, *line, *before, line->middle);
  }
}

DistanceFigures ScanConsistency::figures_of(const std::vector<Distance>& distances) const {
  DistanceFigures figures;
  figures.count = distances.size();
  if (distances.empty()) return figures;
  std::array<std::size_t, stretches> inside{};
  std::array<std::size_t, stretches> counts{};
  std::vector<double> values;
  double sum = 0.0;
  for (const Distance& distance : distances) {
    const std::size_t stretch = stretch_of(distance.scan, scans_);
    ++counts.at(stretch);
    inside.at(stretch) += distance.squared <= chi_square_2_95 ? 1 : 0;
    values.push_back(distance.squared);
    sum += distance.squared;
  }
  ClusteredProportion proportion;
  for (std::size_t k = 0; k < stretches; ++k) proportion.add(inside.at(k), counts.at(k));
  figures.inside95 = scans_ > 1 ? proportion.interval()
                                : quoin::proportion(proportion.hits(), proportion.trials());
  figures.mean = sum / static_cast<double>(values.size());
  std::ranges::sort(values);
  figures.median = quantile(values, 0.5);
  const std::size_t count = std::min(quantile_count, values.size());
  for (std::size_t k = 0; k < count; ++k) {
    // The values are sorted: the nearest is at hand.
    const double at = (static_cast<double>(k) + 0.5) / static_cast<double>(count);
    figures.quantiles.push_back(
        values[static_cast<std::size_t>(at * static_cast<double>(values.size()))]);
  }
  return figures;
}

ScanConsistencyFigures ScanConsistency::figures() const {
  ScanConsistencyFigures figures;
  figures.lines = residuals_.size();
  figures.scans_at_rest = at_rest_;
  std::array<double, stretches> squares{};
  std::array<double, stretches> freedoms{};
  double all_squares = 0.0;
  double all_freedoms = 0.0;
  for (const Residuals& residuals : residuals_) {
    const std::size_t stretch = stretch_of(residuals.scan, scans_);
    squares.at(stretch) += residuals.chi_square;
    freedoms.at(stretch) += residuals.freedom;
    all_squares += residuals.chi_square;
    all_freedoms += residuals.freedom;
  }
  if (all_freedoms > 0.0) {
    MeanSums spread;
    for (std::size_t k = 0; k < stretches; ++k) {
      if (freedoms.at(k) > 0.0) spread.add(squares.at(k) / freedoms.at(k));
    }
    const double value = all_squares / all_freedoms;
    const Interval around = spread.mean();
    const double half = spread.count > 1 ? 0.5 * (around.high - around.low)
                                         : normal_97_5 * value * std::sqrt(2.0 / all_freedoms);
    figures.reduced_chi_square = {value, value - half, value + half};
  }
  for (std::size_t k = 0; k < split_test_count; ++k) {
    figures.modelled.at(k) = figures_of(modelled_.at(k));
    figures.reported.at(k) = figures_of(reported_.at(k));
  }
  return figures;
}

}  // namespace quoin
