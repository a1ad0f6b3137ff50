// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "core/corners/corner_finder.hpp"
#include "core/evaluation/papers/paper_corners.hpp"
#include "core/segmentation/segment.hpp"
#include "core/sensor/points.hpp"
#include "core/simulation/world.hpp"

namespace quoin {

/// The corners of the representative scan and what all scans have in common.
struct WctlsPaperMethod : PaperCorners {
  std::vector<double> median_areas;  ///< [m^2] of each scan's one-sigma ellipses (Fig. 4)
};

/// What the paper shows of one environment.
struct WctlsPaperEnvironment {
  std::string world;
  std::size_t rays = 0;
  std::size_t scans = 0;
  std::size_t representative = 0;       ///< number of the scan that the tables and Fig. 3 show
  std::vector<Eigen::Vector2d> truth;   ///< [m] the corners in sight, clockwise as in the paper
  std::vector<Eigen::Vector2d> points;  ///< [m] of the representative scan
  std::vector<LineSegment> lines;       ///< of the representative scan, by the first fitter
  std::vector<WctlsPaperMethod> methods;
};

/// The experiment of the paper's section 4 on a simulated world: repeated scans of a resting sensor
/// with `noise`, segmented with that, covariances computed from `data_sheet_model()`. The
/// representative scan is the first of those in which most corners are found.
[[nodiscard]] WctlsPaperEnvironment repeat_wctls_paper(const World& world,
                                                       const Segmenter& segmenter,
                                                       const CornerFinder& finder,
                                                       const std::vector<NamedFitter>& fitters,
                                                       const SensorModel& noise, std::size_t scans,
                                                       std::uint64_t seed);

}  // namespace quoin
