// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
//
// How far the covariances of corners can be trusted: every built-in world is scanned with seeded
// noise, segmented by IEPF and fitted by WCTLS, and each corner found is held against the nearest
// true one.
//   corner_coverage [SCANS]
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <vector>

#include <Eigen/LU>

#include "core/corners/adjacent.hpp"
#include "core/fitting/wctls.hpp"
#include "core/segmentation/iepf.hpp"
#include "core/sensor/scan.hpp"
#include "core/simulation/scanner.hpp"
#include "core/simulation/world.hpp"

namespace quoin {
namespace {

struct Counts {
  std::size_t scans = 0, segments = 0, corners = 0, covered = 0, beyond_four_sigma = 0;
  double squared_distances = 0.0;  // of corners within four sigma
};

/// Rays per revolution; the WCTLS paper's section 4 gives those of its environments.
std::size_t points_of(const std::string& world) {
  if (world == "environment_a") return 935;
  if (world == "environment_b") return 887;
  return 920;
}

/// Squared Mahalanobis distance of the nearest true corner.
double distance_to_truth(const CornerEstimate& corner, const World& world) {
  const Eigen::Matrix2d information = corner.covariance.inverse();
  double nearest = std::numeric_limits<double>::infinity();
  for (const Eigen::Vector2d& truth : world.corners()) {
    const Eigen::Vector2d error = corner.position - world.path.front().inverse_transform(truth);
    nearest = std::min(nearest, error.dot(information * error));
  }
  return nearest;
}

Counts count(const std::string& name, std::size_t scans) {
  const SensorModel sensor;
  ScannerSettings settings;
  settings.points = points_of(name);
  settings.noise = sensor;
  SimulatedScanner scanner(built_in_world(name).value(), settings, 1);
  SimulatedScan scan;
  Points points;
  Iepf segmenter;
  const Wctls fitter;
  Adjacent finder;
  std::vector<Segment> segments;
  std::vector<LineSegment> lines;
  std::vector<Corner> corners;
  Counts counts;
  for (; counts.scans < scans; ++counts.scans) {
    scanner.scan(0.0, 0.0, scan);
    convert({scan.bearings, scan.ranges, 0.1F, 40.0F}, points);
    segmenter(points, sensor, segments);
    counts.segments += segments.size();
    lines.clear();
    for (const Segment& segment : segments) {
      const PointsView view = points.view().subview(segment.begin, segment.end);
      const FitResult fit = fitter(view, sensor);
      if (fit.ok()) lines.push_back(line_segment(fit.estimate, view));
    }
    finder(lines, sensor.range_bias_stddev, corners);
    for (const Corner& corner : corners) {
      const double squared = distance_to_truth(corner.estimate, scanner.world());
      ++counts.corners;
      counts.covered += squared <= chi_square_2_95 ? 1 : 0;
      if (squared <= 16.0) {
        counts.squared_distances += squared;
      } else {
        ++counts.beyond_four_sigma;
      }
    }
  }
  return counts;
}

}  // namespace
}  // namespace quoin

int main(int argc, char** argv) {
  const long scans = argc > 1 ? std::atol(argv[1]) : 1000;
  if (scans <= 0) {
    std::fprintf(stderr, "usage: corner_coverage [SCANS]\n");
    return 2;
  }
  std::printf("%-15s %9s %9s %9s %6s %9s\n", "world", "segments", "corners", "coverage", "NEES",
              "> 4 sigma");
  for (const std::string& name : quoin::world_names()) {
    const quoin::Counts counts = quoin::count(name, static_cast<std::size_t>(scans));
    const auto per_scan = [&](std::size_t n) {
      return static_cast<double>(n) / static_cast<double>(counts.scans);
    };
    const auto of_corners = [&](double n) { return n / static_cast<double>(counts.corners); };
    std::printf(
        "%-15s %9.1f %9.1f %7.1f %% %6.2f %7.2f %%\n", name.c_str(), per_scan(counts.segments),
        per_scan(counts.corners), 100.0 * of_corners(static_cast<double>(counts.covered)),
        counts.squared_distances / static_cast<double>(counts.corners - counts.beyond_four_sigma),
        100.0 * of_corners(static_cast<double>(counts.beyond_four_sigma)));
  }
  return 0;
}
