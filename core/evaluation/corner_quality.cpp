// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/evaluation/corner_quality.hpp"

#include <cmath>
#include <vector>

#include <Eigen/LU>

#include "core/geometry/angle.hpp"
#include "core/simulation/random.hpp"
#include "core/simulation/scanner.hpp"
#include "core/simulation/world.hpp"

namespace quoin {
namespace {

constexpr double nearest_stray = 0.2;          // [m]
constexpr double largest_corner_error = 0.15;  // [m]

/// One scan of the world from its first pose, with strays.
void extract(Extraction& extraction, const World& world, const DisturbedScans& disturbed,
             std::uint64_t seed, Random& random) {
  ScannerSettings settings;
  settings.points = disturbed.rays;
  settings.noise = disturbed.noise;
  SimulatedScanner scanner(world, settings, seed);
  SimulatedScan scan;
  scanner.scan(0.0, 0.0, scan);
  for (float& range : scan.ranges) {
    if (!(random.uniform() < disturbed.strays) || !std::isfinite(range)) continue;
    range = static_cast<float>(random.uniform(nearest_stray, static_cast<double>(range)));
  }
  extraction.run(view(scan, settings), disturbed.noise, disturbed.noise);
}

struct CoverageSums {
  std::size_t covered = 0;
  double nees = 0.0;
};

void count(const std::vector<Corner>& corners, const std::vector<Eigen::Vector2d>& truth,
           CornerQuality& quality, CoverageSums& sums) {
  ++quality.scans;
  quality.true_corners += truth.size();
  std::vector<bool> found(truth.size());
  for (const Corner& corner : corners) {
    bool is_true = false;
    for (std::size_t k = 0; k < truth.size(); ++k) {
      const Eigen::Vector2d error = corner.estimate.position - truth[k];
      if (error.norm() > largest_corner_error) continue;
      is_true = true;
      if (found[k]) continue;
      found[k] = true;
      ++quality.found_corners;
      const double squared = error.dot(corner.estimate.covariance.inverse() * error);
      sums.nees += squared;
      sums.covered += squared <= chi_square_2_95 ? 1 : 0;
    }
    quality.false_corners += is_true ? 0 : 1;
  }
}

}  // namespace

CornerQuality judge_room_corners(Extraction& extraction, const DisturbedScans& disturbed) {
  CornerQuality quality;
  CoverageSums sums;
  Random random(disturbed.seed);
  const std::vector<Eigen::Vector2d> corners{{0.0, 0.0}, {5.0, 0.0}, {5.0, 3.5}, {0.0, 3.5}};
  World world;
  world.add_polyline(corners, true);
  for (std::size_t k = 0; k < disturbed.scans; ++k) {
    const Pose2 pose{random.uniform(0.4, 4.6), random.uniform(0.4, 3.1), random.uniform(-pi, pi)};
    world.path = {pose};
    std::vector<Eigen::Vector2d> truth;
    for (const Eigen::Vector2d& corner : corners) truth.push_back(pose.inverse_transform(corner));
    extract(extraction, world, disturbed, disturbed.seed + k, random);
    count(extraction.corners(), truth, quality, sums);
  }
  quality.recall = proportion(quality.found_corners, quality.true_corners);
  quality.coverage = proportion(sums.covered, quality.found_corners);
  if (quality.found_corners > 0) {
    quality.mean_nees = sums.nees / static_cast<double>(quality.found_corners);
  }
  return quality;
}

CornerQuality judge_column(Extraction& extraction, double radius, double distance,
                           const DisturbedScans& disturbed) {
  CornerQuality quality;
  CoverageSums sums;
  Random random(disturbed.seed);
  World world;
  world.pillars = {{{distance + radius, 0.0}, radius}};
  for (std::size_t k = 0; k < disturbed.scans; ++k) {
    world.path = {{0.0, 0.0, random.uniform(-pi, pi)}};
    extract(extraction, world, disturbed, disturbed.seed + k, random);
    count(extraction.corners(), {}, quality, sums);
  }
  return quality;
}

}  // namespace quoin
