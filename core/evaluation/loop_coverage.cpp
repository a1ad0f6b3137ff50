// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/evaluation/loop_coverage.hpp"

#include <algorithm>
#include <limits>
#include <vector>

#include <Eigen/LU>

namespace quoin {
namespace {

constexpr double four_sigma = 16.0;  // squared Mahalanobis distance

/// Squared Mahalanobis distance of the nearest true corner.
double distance_to_truth(const CornerEstimate& corner, const std::vector<Eigen::Vector2d>& truth) {
  const Eigen::Matrix2d information = corner.covariance.inverse();
  double nearest = std::numeric_limits<double>::infinity();
  for (const Eigen::Vector2d& point : truth) {
    const Eigen::Vector2d error = corner.position - point;
    nearest = std::min(nearest, error.dot(information * error));
  }
  return nearest;
}

/// Counts of scans of which the fraction of covered corners is wanted. The corners of one scan
/// share lines and are not independent, its counts are independent of those of the next.
class ClusteredProportion {
 public:
  void add(std::size_t hits, std::size_t trials) {
    const auto h = static_cast<double>(hits);
    const auto t = static_cast<double>(trials);
    hits_ += hits;
    trials_ += trials;
    hits_squared_ += h * h;
    product_ += h * t;
    trials_squared_ += t * t;
  }

  [[nodiscard]] Interval interval() const {
    if (trials_ == 0) return {};
    const auto count = static_cast<double>(trials_);
    const double p = static_cast<double>(hits_) / count;
    // Linearised variance of a ratio of sums over clusters.
    const double variance =
        (hits_squared_ - 2.0 * p * product_ + p * p * trials_squared_) / (count * count);
    const double effective = variance > 0.0 ? std::min(count, p * (1.0 - p) / variance) : count;
    return proportion(hits_, trials_, effective > 0.0 ? effective : count);
  }

 private:
  std::size_t hits_ = 0, trials_ = 0;
  double hits_squared_ = 0.0, product_ = 0.0, trials_squared_ = 0.0;
};

}  // namespace

LoopCoverage judge_loop(Extraction& extraction, const World& world, const SensorModel& noise,
                        std::size_t scans, std::uint64_t seed) {
  ScannerSettings settings;
  settings.points = rays_per_revolution(world.name);
  settings.noise = noise;
  SimulatedScanner scanner(world, settings, seed);
  std::vector<Eigen::Vector2d> truth = world.corners();
  for (Eigen::Vector2d& point : truth) point = world.pose_at(0.0).inverse_transform(point);

  LoopCoverage result;
  SimulatedScan scan;
  ClusteredProportion coverage;
  std::size_t segments = 0, corners = 0;
  MeanSums nees;  // of the corners within four sigma
  for (; result.scans < scans; ++result.scans) {
    scanner.scan(0.0, 0.0, scan);
    extraction.run(view(scan, settings), noise, noise);
    segments += extraction.segments().size();
    corners += extraction.corners().size();
    extraction.count_failures(result.failures);
    std::size_t covered = 0;
    for (const Corner& corner : extraction.corners()) {
      const double squared = distance_to_truth(corner.estimate, truth);
      covered += squared <= chi_square_2_95 ? 1 : 0;
      if (squared <= four_sigma) nees.add(squared);
    }
    coverage.add(covered, extraction.corners().size());
  }
  if (scans == 0) return result;
  result.segments_per_scan = static_cast<double>(segments) / static_cast<double>(scans);
  result.corners_per_scan = static_cast<double>(corners) / static_cast<double>(scans);
  result.coverage95 = coverage.interval();
  result.nees = nees.mean();
  if (corners > 0) {
    result.beyond_four_sigma =
        static_cast<double>(corners - nees.count) / static_cast<double>(corners);
  }
  return result;
}

}  // namespace quoin
