// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/extraction/extraction.hpp"

namespace quoin {

std::size_t rays_per_revolution(std::string_view world) {
  if (world == "environment_a") return 935;
  if (world == "environment_b") return 887;
  return 920;
}

ScanView view(const SimulatedScan& scan, const ScannerSettings& settings) {
  return {scan.bearings, scan.ranges, static_cast<float>(settings.range_min),
          static_cast<float>(settings.range_max)};
}

void Extraction::run(const ScanView& scan, const SensorModel& segmentation,
                     const SensorModel& fitting) {
  convert(scan, points_);
  segmenter_(points_, segmentation, found_);
  set_aside(points_, found_);
  lines_.clear();
  fitted_.clear();
  failures_.clear();
  for (const Segment& segment : found_.segments) {
    const PointsView points = points_.view().subview(segment.begin, segment.end);
    const FitResult fit = fitter_(points, fitting);
    if (!fit.ok()) {
      failures_.push_back(fit.failure);
      continue;
    }
    const double residuals = chi_square(fit.estimate.line, points, fitting);
    lines_.push_back(true_segment(fit, points, fitting, residuals));
    fitted_.push_back(segment);
  }
  finder_(lines_, fitting.range_bias_stddev, corners_);
}

void Extraction::count_failures(FailureCounts& counts) const {
  for (const FitFailure failure : failures_) ++counts[static_cast<std::size_t>(failure)];
  counts[static_cast<std::size_t>(FitFailure::none)] += lines_.size();
}

}  // namespace quoin
