// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "core/extraction/extraction.hpp"

namespace quoin {

/// What can be said of extracted scans whose truth is not known.
struct ScanFigures {
  std::size_t scans = 0;
  double segments_per_scan = 0.0;
  double corners_per_scan = 0.0;
  double median_sigma = 0.0;         ///< [m] of the corners, sqrt((Cxx + Cyy) / 2)
  double median_ellipse_area = 0.0;  ///< [m^2] of the corners' one-sigma ellipses
  /// Median over the lines of chi-square / (points - 2): above 1 when walls are less straight or
  /// noise is larger than the sensor model says.
  double median_reduced_chi_square = 0.0;
  FailureCounts failures{};
};

/// Collects the figures scan by scan.
class ScanStatistics {
 public:
  /// Takes what the last scan of `extraction` gave, fitted with `sensor`.
  void add(const Extraction& extraction, const SensorModel& sensor);
  [[nodiscard]] ScanFigures figures() const;

 private:
  std::size_t scans_ = 0;
  std::size_t segments_ = 0;
  std::vector<double> sigmas_;
  std::vector<double> areas_;
  std::vector<double> reduced_chi_squares_;
  FailureCounts failures_{};
};

}  // namespace quoin
