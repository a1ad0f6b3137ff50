// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <limits>
#include <string_view>
#include <utility>
#include <vector>

#include "core/corners/corner_finder.hpp"
#include "core/fitting/fit.hpp"
#include "core/segmentation/segment.hpp"
#include "core/sensor/scan.hpp"
#include "core/simulation/scanner.hpp"

namespace quoin {

/// Rays per revolution in a built-in world: what the WCTLS paper's section 4 gives for its two
/// environments, elsewhere those of an RPLIDAR S1 at 10 Hz.
[[nodiscard]] std::size_t rays_per_revolution(std::string_view world);

/// A simulated scan with the limits of the scanner that made it.
[[nodiscard]] ScanView view(const SimulatedScan& scan, const ScannerSettings& settings);

/// From a scan to corners, as the services do it one after the other. A segment without a line is
/// left out and its failure kept.
class Extraction {
 public:
  Extraction(Segmenter segmenter, Fitter fitter, CornerFinder finder)
      : segmenter_(std::move(segmenter)), fitter_(std::move(fitter)), finder_(std::move(finder)) {}

  /// The segmenter may have another sensor model than the fitter: the real noise decides where a
  /// wall ends, independent of the noise that the covariances are computed from.
  void run(const ScanView& scan, const SensorModel& segmentation, const SensorModel& fitting);

  // What the last scan gave; valid until the next.
  [[nodiscard]] const Points& points() const { return points_; }
  [[nodiscard]] const std::vector<Segment>& segments() const { return found_.segments; }
  [[nodiscard]] const std::vector<LineSegment>& lines() const { return lines_; }
  /// Runs of points on round things.
  [[nodiscard]] const std::vector<Segment>& arcs() const { return found_.arcs; }
  /// The segment of each line.
  [[nodiscard]] const std::vector<Segment>& fitted() const { return fitted_; }
  [[nodiscard]] const std::vector<FitFailure>& failures() const { return failures_; }
  [[nodiscard]] const std::vector<Corner>& corners() const { return corners_.corners; }
  /// Adds the segments of the last scan to `counts`, those with a line under FitFailure::none.
  void count_failures(FailureCounts& counts) const;

 private:
  Segmenter segmenter_;
  Fitter fitter_;
  CornerFinder finder_;
  Points points_;
  Segmentation found_;
  std::vector<LineSegment> lines_;
  std::vector<Segment> fitted_;
  std::vector<FitFailure> failures_;
  FoundCorners corners_;
};

}  // namespace quoin
