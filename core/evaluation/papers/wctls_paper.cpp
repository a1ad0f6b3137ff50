// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/evaluation/papers/wctls_paper.hpp"

#include <algorithm>

#include "core/evaluation/corner_matching.hpp"
#include "core/evaluation/scene.hpp"
#include "core/extraction/extraction.hpp"
#include "core/statistics/order_statistics.hpp"

namespace quoin {
namespace {

/// What was found of each true corner.
std::vector<std::optional<CornerEstimate>> assign(const std::vector<Corner>& found,
                                                  const std::vector<Eigen::Vector2d>& truth) {
  std::vector<CornerEstimate> estimates;
  for (const Corner& corner : found) estimates.push_back(corner.estimate);
  std::vector<std::optional<CornerEstimate>> assigned(truth.size());
  for (const TruthMatch& match : match_truth(estimates, truth)) {
    assigned[match.truth] = estimates[match.found];
  }
  return assigned;
}

std::size_t count_found(const std::vector<std::optional<CornerEstimate>>& corners) {
  return static_cast<std::size_t>(
      std::count_if(corners.begin(), corners.end(), [](const auto& c) { return c.has_value(); }));
}

std::vector<Eigen::Vector2d> cartesian(const Points& points) {
  std::vector<Eigen::Vector2d> result;
  for (std::size_t i = 0; i < points.size(); ++i) result.emplace_back(points.x[i], points.y[i]);
  return result;
}

}  // namespace

WctlsPaperEnvironment repeat_wctls_paper(const World& world, const Segmenter& segmenter,
                                         const CornerFinder& finder,
                                         const std::vector<NamedFitter>& fitters,
                                         const SensorModel& noise, std::size_t scans,
                                         std::uint64_t seed) {
  WctlsPaperEnvironment result;
  result.world = world.name;
  result.rays = rays_per_revolution(world.name);
  result.scans = scans;
  for (const VisibleCorner& corner : observe(world, world.pose_at(0.0), result.rays).corners) {
    result.truth.push_back(corner.position);
  }
  std::reverse(result.truth.begin(), result.truth.end());

  ScannerSettings settings;
  settings.points = result.rays;
  settings.noise = noise;
  SimulatedScanner scanner(world, settings, seed);
  std::vector<SimulatedScan> recorded(scans);
  for (SimulatedScan& scan : recorded) scanner.scan(0.0, 0.0, scan);

  const SensorModel paper = data_sheet_model();
  if (fitters.empty() || scans == 0) return result;
  Extraction chooser(segmenter, fitters.front().fitter, finder);
  std::size_t most = 0;
  for (std::size_t k = 0; k < scans; ++k) {
    chooser.run(view(recorded[k], settings), noise, paper);
    const std::size_t found = count_found(assign(chooser.corners(), result.truth));
    if (found <= most) continue;
    most = found;
    result.representative = k;
    result.lines = chooser.lines();
    result.points = cartesian(chooser.points());
  }

  for (const NamedFitter& named : fitters) {
    Extraction extraction(segmenter, named.fitter, finder);
    WctlsPaperMethod method{{named.name, named.covariance, {}}, {}};
    for (std::size_t k = 0; k < scans; ++k) {
      extraction.run(view(recorded[k], settings), noise, paper);
      if (k == result.representative) method.corners = assign(extraction.corners(), result.truth);
      std::vector<double> areas;
      for (const Corner& corner : extraction.corners()) {
        areas.push_back(one_sigma_ellipse_area(corner.estimate.covariance));
      }
      if (!areas.empty()) method.median_areas.push_back(median(std::move(areas)));
    }
    result.methods.push_back(std::move(method));
  }
  return result;
}

}  // namespace quoin
