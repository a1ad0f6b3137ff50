// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/evaluation/corner_quality.hpp"

#include <algorithm>
#include <cmath>

#include "core/evaluation/corner_matching.hpp"
#include "core/evaluation/scene.hpp"
#include "core/geometry/angle.hpp"
#include "core/statistics/chi_square.hpp"

namespace quoin {
namespace {

constexpr double same_corner = 1e-3;  // [m]

bool sees_enough(const VisibleWall& wall, std::size_t far_ray, const Eigen::Vector2d& corner,
                 const SeenWalls& seen) {
  const double range = wall.ranges[far_ray];
  const double bearing = wall.bearings[far_ray];
  const Eigen::Vector2d far(range * std::cos(bearing), range * std::sin(bearing));
  return wall.bearings.size() >= seen.min_points && (far - corner).norm() >= seen.min_length;
}

/// A scan of the world from the first pose of its path.
void extract(Extraction& extraction, const World& world, const DisturbedScans& disturbed,
             std::size_t scan) {
  DisturbedScanner scanner(world, disturbed, disturbed.seed + scan);
  static_cast<void>(scanner.scan());
  extraction.run(scanner.view(), disturbed.noise, disturbed.noise);
}

}  // namespace

CornerTruth corner_truth(const World& world, const Pose2& pose, std::size_t rays,
                         const SeenWalls& seen) {
  CornerTruth truth;
  for (const Eigen::Vector2d& corner : world.corners()) {
    truth.positions.push_back(pose.inverse_transform(corner));
  }
  truth.to_be_found.resize(truth.positions.size());
  const Scene scene = observe(world, pose, rays, 1);
  for (const VisibleCorner& corner : scene.corners) {
    const VisibleWall& first = scene.walls[corner.first];
    const VisibleWall& second = scene.walls[corner.second];
    if (!sees_enough(first, 0, corner.position, seen)) continue;
    if (!sees_enough(second, second.bearings.size() - 1, corner.position, seen)) continue;
    const auto same = std::ranges::find_if(truth.positions, [&](const Eigen::Vector2d& position) {
      return (position - corner.position).norm() <= same_corner;
    });
    if (same == truth.positions.end()) continue;
    truth.to_be_found[static_cast<std::size_t>(same - truth.positions.begin())] = true;
  }
  return truth;
}

void CornerTally::add(const std::vector<Corner>& found, const CornerTruth& truth) {
  ++scans_;
  corners_.resize(std::max(corners_.size(), first_corner_ + truth.positions.size()));
  std::vector<CornerEstimate> estimates;
  for (const Corner& corner : found) estimates.push_back(corner.estimate);
  const std::vector<TruthMatch> matches = match_truth(estimates, truth.positions);
  std::size_t covered = 0;
  std::size_t recalled = 0;
  for (const TruthMatch& match : matches) {
    const double squared = match.mahalanobis_squared;
    CornerCoverage& corner = corners_[first_corner_ + match.truth];
    ++corner.observations;
    recalled += truth.to_be_found[match.truth] ? 1 : 0;
    if (squared <= chi_square_2_95) {
      ++covered;
      ++corner.covered;
    }
    if (squared <= four_sigma_squared) {
      nees_.add(squared);
    } else {
      ++beyond_;
      ++corner.beyond_four_sigma;
    }
  }
  const auto expected = std::ranges::count(truth.to_be_found, true);
  recall_.add(recalled, static_cast<std::size_t>(expected));
  precision_.add(matches.size(), found.size());
  coverage_.add(covered, matches.size());
}

CornerQuality CornerTally::quality() const {
  CornerQuality quality;
  quality.scans = scans_;
  quality.true_corners = recall_.trials();
  quality.found_corners = precision_.trials();
  quality.false_corners = precision_.trials() - precision_.hits();
  quality.recall = recall_.interval();
  quality.precision = precision_.interval();
  quality.coverage = coverage_.interval();
  quality.nees = nees_.mean();
  if (coverage_.trials() > 0) {
    quality.beyond_four_sigma =
        static_cast<double>(beyond_) / static_cast<double>(coverage_.trials());
  }
  quality.corners = corners_;
  return quality;
}

CornerQuality judge_room_corners(Extraction& extraction, const DisturbedScans& disturbed) {
  CornerTally tally;
  Random random(disturbed.seed);
  World world;
  world.add_polyline({{0.0, 0.0}, {5.0, 0.0}, {5.0, 3.5}, {0.0, 3.5}}, true);
  for (std::size_t k = 0; k < disturbed.scans; ++k) {
    const Pose2 pose{random.uniform(0.4, 4.6), random.uniform(0.4, 3.1), random.uniform(-pi, pi)};
    world.path = {pose};
    CornerTruth truth;
    for (const Eigen::Vector2d& corner : world.corners()) {
      truth.positions.push_back(pose.inverse_transform(corner));
    }
    truth.to_be_found.assign(truth.positions.size(), true);
    extract(extraction, world, disturbed, k);
    tally.add(extraction.corners(), truth);
  }
  return tally.quality();
}

CornerQuality judge_column(Extraction& extraction, double radius, double distance,
                           const DisturbedScans& disturbed) {
  CornerTally tally;
  Random random(disturbed.seed);
  World world;
  world.pillars = {{{distance + radius, 0.0}, radius}};
  for (std::size_t k = 0; k < disturbed.scans; ++k) {
    world.path = {{0.0, 0.0, random.uniform(-pi, pi)}};
    extract(extraction, world, disturbed, k);
    tally.add(extraction.corners(), {});
  }
  return tally.quality();
}

}  // namespace quoin
