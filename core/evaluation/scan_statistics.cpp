// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/evaluation/scan_statistics.hpp"

#include <cmath>

#include "core/statistics/order_statistics.hpp"

namespace quoin {

void ScanStatistics::add(const Extraction& extraction, const SensorModel& sensor) {
  ++scans_;
  segments_ += extraction.segments().size();
  extraction.count_failures(failures_);
  for (std::size_t k = 0; k < extraction.lines().size(); ++k) {
    const Segment& segment = extraction.fitted()[k];
    if (segment.size() < 3) continue;
    const PointsView points = extraction.points().view().subview(segment.begin, segment.end);
    const double reduced = chi_square(extraction.lines()[k].estimate.line, points, sensor) /
                           static_cast<double>(segment.size() - 2);
    if (std::isfinite(reduced)) reduced_chi_squares_.push_back(reduced);
  }
  for (const Corner& corner : extraction.corners()) {
    sigmas_.push_back(std::sqrt(0.5 * corner.estimate.covariance.trace()));
    areas_.push_back(one_sigma_ellipse_area(corner.estimate.covariance));
  }
}

ScanFigures ScanStatistics::figures() const {
  ScanFigures figures;
  figures.scans = scans_;
  figures.failures = failures_;
  if (scans_ == 0) return figures;
  figures.segments_per_scan = static_cast<double>(segments_) / static_cast<double>(scans_);
  figures.corners_per_scan = static_cast<double>(sigmas_.size()) / static_cast<double>(scans_);
  figures.median_sigma = median(sigmas_);
  figures.median_ellipse_area = median(areas_);
  figures.median_reduced_chi_square = median(reduced_chi_squares_);
  return figures;
}

}  // namespace quoin
