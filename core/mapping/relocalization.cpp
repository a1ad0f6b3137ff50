// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/mapping/relocalization.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <Eigen/Eigenvalues>

#include "core/geometry/angle.hpp"
#include "core/mapping/nearby_points.hpp"
#include "core/mapping/scan_judgement.hpp"

namespace quoin {
namespace {

constexpr std::size_t least_points = 40;    // of a scan
constexpr double least_found_share = 0.8;   // of them that lie on the map
constexpr double least_contradicted = 1.5;  // [m] more at any other place
constexpr double search_period = 0.5;       // [s]

/// Length [m] of what is seen where the map has nothing, and of mapped walls that are seen through.
double contradicted_length(const Relocalization::Scan& scan, const Registration& registration) {
  std::vector<std::size_t> walls;
  for (std::size_t i = 0; i < scan.graph.landmarks().size(); ++i) {
    if (scan.graph.landmarks()[i].alive) walls.push_back(i);
  }
  return (1.0 - registration.share) * static_cast<double>(scan.points.size()) * point_spacing +
         seen_through(registration.estimate.pose, scan.graph.landmarks(), walls, scan.measurements);
}

/// Whether nearly all that is seen lies on the map there, and the position is determined in every
/// direction.
bool lies_at(const Relocalization::Scan& scan, const Registration& registration) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes(
      Eigen::Matrix2d(registration.estimate.covariance.topLeftCorner<2, 2>()));
  const double length = static_cast<double>(scan.points.size()) * point_spacing;
  return registration.share > least_found_share && axes.eigenvalues()(1) < 0.1 * 0.1 &&
         contradicted_length(scan, registration) < std::max(least_refuted, 0.25 * length);
}

}  // namespace

/// The points of the whole map: of all keyframes, or of all given walls.
void Relocalization::build(const Scan& scan) {
  constexpr double margin = 2.0;  // [m]
  const auto& keyframes = scan.graph.keyframes();
  Eigen::Vector2d low(1e9, 1e9), high(-1e9, -1e9);
  for (const LineLandmark& landmark : scan.graph.landmarks()) {
    if (!landmark.alive) continue;
    for (const double s : {landmark.low, landmark.high}) {
      low = low.cwiseMin(landmark.at(s));
      high = high.cwiseMax(landmark.at(s));
    }
  }
  if (!scan.clouds.empty()) {
    for (const LandmarkGraph::Keyframe& keyframe : keyframes) {
      low = low.cwiseMin(Eigen::Vector2d(keyframe.pose.x, keyframe.pose.y));
      high = high.cwiseMax(Eigen::Vector2d(keyframe.pose.x, keyframe.pose.y));
    }
  }
  window_.center = {0.5 * (low.x() + high.x()), 0.5 * (low.y() + high.y()), 0.0};
  window_.translation = 0.5 * (high - low).maxCoeff();
  window_.turn = pi;
  whole_.clear(0.5 * (low + high), window_.translation + margin);
  if (!scan.clouds.empty()) {
    for (std::size_t k = 0; k < keyframes.size(); ++k)
      whole_.add(keyframes[k].pose, scan.clouds[k]);
    return;
  }
  for (const LineLandmark& landmark : scan.graph.landmarks()) whole_.add({}, points_on(landmark));
}

/// Where on the whole map the points of the scan lie, if they lie at one place only.
std::optional<Registration> Relocalization::search(const Scan& scan) {
  std::vector<Registration> refined;
  for (const PointMap::Candidate& candidate : whole_.search(scan.points, window_, 20)) {
    const PoseEstimate prior{candidate.pose, 0.04 * Eigen::Matrix3d::Identity()};
    refined.push_back(whole_.refine(scan.points, candidate.pose, prior));
  }
  if (refined.empty()) return std::nullopt;
  const Registration best = *std::max_element(
      refined.begin(), refined.end(),
      [](const Registration& a, const Registration& b) { return a.share < b.share; });
  if (!lies_at(scan, best)) return std::nullopt;
  // Every other place contradicts the scan by more than a door or a sofa that people move.
  for (const Registration& other : refined) {
    const Pose2 apart = between(best.estimate.pose, other.estimate.pose);
    if (std::hypot(apart.x, apart.y) < 0.3 && std::abs(apart.theta) < 0.15) continue;
    if (contradicted_length(scan, other) < contradicted_length(scan, best) + least_contradicted) {
      return std::nullopt;
    }
  }
  return best;
}

std::optional<Registration> Relocalization::look(const Scan& scan) {
  if (scan.points.size() < least_points) {
    candidate_.reset();
    return std::nullopt;
  }
  if (whole_.empty()) build(scan);
  std::optional<Registration> found;
  if (candidate_) {
    if (scan.motion) candidate_ = compose(*candidate_, scan.motion->pose);
    const PoseEstimate prior{*candidate_, 0.04 * Eigen::Matrix3d::Identity()};
    for (const PointMap::Candidate& near : whole_.search(scan.points, {*candidate_, 0.3, 0.2}, 1)) {
      found = whole_.refine(scan.points, near.pose, prior);
    }
    if (found && !lies_at(scan, *found)) found.reset();
    ++found_scans_;
  } else if (scan.stamp >= next_search_) {
    next_search_ = scan.stamp + search_period;
    found = search(scan);
    found_scans_ = 0;
  }
  candidate_.reset();
  if (!found) return std::nullopt;
  const Pose2 pose = found->estimate.pose;
  if (found_scans_ < lost_scans) {
    candidate_ = pose;
    return std::nullopt;
  }
  forget_map();
  found_scans_ = 0;
  return found;
}

}  // namespace quoin
