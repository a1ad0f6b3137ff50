// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "deploy/calibration/calibration.hpp"

#include <algorithm>
#include <cmath>

#include "core/calibration/noise_estimator.hpp"
#include "core/fitting/fitters.hpp"
#include "core/segmentation/segmenters.hpp"
#include "core/statistics/order_statistics.hpp"

namespace quoin::deploy {

namespace {

constexpr int passes = 3;
// How far the measured distance may be from the given one.
constexpr double largest_bias = 0.3;  // [m]
// Shorter pieces may be clutter.
constexpr std::size_t fewest_points = 20;

/// Mean error [m] of the ranges of a wall at this distance along its normal, of the rays that meet
/// it nearly head on: an error along the others moves the line by less.
std::optional<double> mean_range_error(const PointsView& points, const Eigen::Vector2d& normal,
                                       double distance) {
  constexpr double smallest_cosine = 0.9;
  double sum = 0.0;
  double count = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double cosine = points.cosine[i] * normal.x() + points.sine[i] * normal.y();
    if (cosine < smallest_cosine) continue;
    sum += points.range[i] - distance / cosine;
    count += 1.0;
  }
  if (count == 0.0) return std::nullopt;
  return sum / count;
}

/// Error [m] of the ranges of the wall nearest to the given distance, of those that are seen head
/// on.
std::optional<double> range_error(const PointsView& points, const Segmentation& found,
                                  const SensorModel& sensor, double distance) {
  static const auto fitter = Fitters::make<Fitter>(Fitters::descriptions().front().name, {});
  std::optional<double> best;
  for (const Segment& wall : found.segments) {
    if (wall.size() < fewest_points) continue;
    const PointsView view = points.subview(wall.begin, wall.end);
    const FitResult fit = fitter(view, sensor);
    if (!fit.ok() || std::abs(fit.estimate.line.r - distance) > largest_bias) continue;
    const LineSegment line = line_segment(fit.estimate, fit.normal, view);
    // The foot of the perpendicular is between the ends.
    const double start = fit.normal.x() * line.start.y() - fit.normal.y() * line.start.x();
    const double end = fit.normal.x() * line.end.y() - fit.normal.y() * line.end.x();
    if (start * end > 0.0) continue;
    const auto error = mean_range_error(view, fit.normal, distance);
    if (error && (!best || std::abs(*error) < std::abs(*best))) best = error;
  }
  return best;
}

/// Half of the errors below and half above; the interval by the order statistics of the median.
std::optional<RangeBias> bias_of(const std::vector<double>& errors) {
  if (errors.empty()) return std::nullopt;
  const auto count = static_cast<double>(errors.size());
  const double reach = 0.98 / std::sqrt(count);  // 1.96 / (2 sqrt(n)) of the ranks
  return RangeBias{{median(errors), quantile(errors, std::max(0.0, 0.5 - reach)),
                    quantile(errors, std::min(1.0, 0.5 + reach))},
                   errors.size()};
}

}  // namespace

void CollectedScans::add(const ScanView& scan) {
  const std::size_t number = added_++;
  if (number % stride_ != 0) return;
  scans_.push_back({{scan.bearings.begin(), scan.bearings.end()},
                    {scan.ranges.begin(), scan.ranges.end()},
                    scan.range_min,
                    scan.range_max});
  rays_ += scan.ranges.size();
  while (rays_ > most_rays_ && scans_.size() > 1) {
    std::vector<Scan> kept;
    rays_ = 0;
    for (std::size_t k = 0; k < scans_.size(); k += 2) {
      rays_ += scans_[k].ranges.size();
      kept.push_back(std::move(scans_[k]));
    }
    scans_ = std::move(kept);
    stride_ *= 2;
  }
}

ScanView CollectedScans::scan(std::size_t index) const {
  const Scan& scan = scans_.at(index);
  return {scan.bearings, scan.ranges, scan.range_min, scan.range_max};
}

std::optional<Calibration> calibrate(const CollectedScans& scans, std::optional<double> distance,
                                     const std::function<bool(double done)>& proceed) {
  Calibration result;
  result.distance = distance;
  SensorModel model;
  const auto segment = Segmenters::make<Segmenter>(Segmenters::descriptions().front().name, {});
  Points points;
  Segmentation found;
  std::vector<double> errors;
  for (int pass = 0; pass < passes; ++pass) {
    NoiseEstimator estimator;
    errors.clear();
    for (std::size_t k = 0; k < scans.size(); ++k) {
      const double work =
          static_cast<double>(pass) + static_cast<double>(k) / static_cast<double>(scans.size());
      if (!proceed(work / passes)) return std::nullopt;
      convert(scans.scan(k), points);
      segment(points, model, found);
      set_aside(points, found);
      estimator.add(points, found.segments);
      if (!distance) continue;
      if (const auto error = range_error(points, found, model, *distance)) errors.push_back(*error);
    }
    const bool last = pass + 1 == passes;
    if (last) {
      result.noise = estimator.estimate(model);
    } else {
      const NoiseComponents components = estimator.components(model);
      if (components.range_stddev > 0.0) model = components.model();
    }
  }
  result.bias = bias_of(errors);
  return result;
}

}  // namespace quoin::deploy
