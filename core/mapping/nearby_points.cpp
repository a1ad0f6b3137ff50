// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/mapping/nearby_points.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/mapping/scan_judgement.hpp"
#include "core/statistics/order_statistics.hpp"

namespace quoin {

void points_of(std::span<const LineMeasurement> lines, std::vector<SurfacePoint>& result) {
  result.clear();
  for (const LineMeasurement& m : lines) {
    const Eigen::Vector2d normal(std::cos(m.alpha), std::sin(m.alpha));
    const Eigen::Vector2d along(-normal.y(), normal.x());
    const int count = std::max(2, static_cast<int>(2.0 * m.half_length / 0.1));
    for (int i = 0; i < count; ++i) {
      const double t = m.half_length * (2.0 * (i + 0.5) / count - 1.0);
      SurfacePoint point;
      point.position = (m.middle + t * along).cast<float>();
      point.normal = (-normal).cast<float>();
      result.push_back(point);
    }
  }
}

std::vector<SurfacePoint> points_on(const LineLandmark& landmark) {
  const int steps = std::max(2, static_cast<int>(landmark.length() / 0.05));
  std::vector<SurfacePoint> points(static_cast<std::size_t>(steps));
  for (int i = 0; i < steps; ++i) {
    SurfacePoint& point = points[static_cast<std::size_t>(i)];
    const double s = landmark.low + (i + 0.5) / steps * landmark.length();
    point.position = landmark.at(s).cast<float>();
    point.normal = (-landmark.normal()).cast<float>();
  }
  return points;
}

std::vector<std::size_t> keyframes_around(const LandmarkGraph& graph, const Pose2& pose,
                                          std::size_t base, double reach) {
  constexpr std::size_t last = 15;
  constexpr std::size_t most = 40;
  const auto& keyframes = graph.keyframes();
  std::vector<char> seen(graph.landmarks().size(), 0);
  const std::size_t count = keyframes.size();
  const std::size_t end = std::min(count, base + 3);
  for (std::size_t k = end > 6 ? end - 6 : 0; k < end; ++k) {
    for (const auto& observation : keyframes[k].observations) seen[observation.landmark] = 1;
  }
  std::vector<std::pair<double, std::size_t>> chosen;
  for (std::size_t k = 0; k < count; ++k) {
    const double distance = std::hypot(keyframes[k].pose.x - pose.x, keyframes[k].pose.y - pose.y);
    std::size_t common = 0;
    for (const auto& observation : keyframes[k].observations) {
      common += seen[observation.landmark] != 0 ? 1 : 0;
    }
    if (k < end && k + last >= end) {
      chosen.emplace_back(-1.0, k);
    } else if (distance < reach && common >= 3) {
      chosen.emplace_back(distance, k);
    }
  }
  return indices_of_least(std::move(chosen), most);
}

std::size_t nearest_keyframe(const LandmarkGraph& graph, const Pose2& pose) {
  std::size_t nearest = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < graph.keyframes().size(); ++k) {
    const Pose2 apart = between(pose, graph.keyframes()[k].pose);
    const double distance = apart.x * apart.x + apart.y * apart.y + apart.theta * apart.theta;
    if (distance >= least) continue;
    least = distance;
    nearest = k;
  }
  return nearest;
}

std::optional<Registration> register_scan(PointMap& around, std::span<const SurfacePoint> scan,
                                          const Pose2& predicted, const PoseWindow& window) {
  if (around.empty() || scan.size() < 10) return std::nullopt;
  PoseEstimate prior{predicted, Eigen::Matrix3d::Zero()};
  const double position = 0.5 * window.translation;
  const double heading = 0.5 * window.turn;
  prior.covariance.diagonal() << position * position, position * position, heading * heading;
  std::optional<Registration> best;
  double best_value = 0.0;
  const auto consider = [&](const Pose2& start) {
    const Registration tried = around.refine(scan, start, prior);
    const Pose2 off = between(predicted, tried.estimate.pose);
    const double squared = (off.x * off.x + off.y * off.y) / (position * position) +
                           off.theta * off.theta / (heading * heading);
    const double value = tried.share - 0.02 * std::min(squared, 10.0);
    if (best && value <= best_value) return;
    best_value = value;
    best = tried;
  };
  consider(predicted);
  for (const PointMap::Candidate& candidate : around.search(scan, window, 3)) {
    consider(candidate.pose);
  }
  if (best->share < least_share) return std::nullopt;
  return best;
}

}  // namespace quoin
