// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/mapping/scan_judgement.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Eigenvalues>

#include "core/geometry/angle.hpp"
#include "core/mapping/wall_matching.hpp"

namespace quoin {
namespace {

constexpr double lost_after = 0.6;        // [s]
constexpr int scans_back = 5;             // in a row
constexpr double short_step = 0.25;       // [m]
constexpr double short_turn = 0.35;       // [rad]
constexpr double weak_position = 0.25;    // [m] by the walls alone
constexpr double largest_fall = 0.3;      // of the share, from one scan to the next
constexpr std::size_t blind_points = 10;  // of a scan that says nothing

}  // namespace

double seen_through(const Pose2& pose, std::span<const LineLandmark> map,
                    std::span<const std::size_t> walls,
                    std::span<const LineMeasurement> measurements) {
  constexpr int samples = 5;
  double length = 0.0;
  for (const std::size_t index : walls) {
    const LineLandmark& landmark = map[index];
    if (landmark.observations < 3) continue;
    for (int i = 0; i < samples; ++i) {
      const double s = landmark.low + (i + 0.5) / samples * landmark.length();
      const Eigen::Vector2d point = pose.inverse_transform(landmark.at(s));
      const double distance = point.norm();
      if (distance < 0.3) continue;
      for (const LineMeasurement& m : measurements) {
        const Eigen::Vector2d normal(std::cos(m.alpha), std::sin(m.alpha));
        const Eigen::Vector2d tangent(-normal.y(), normal.x());
        const double approach = normal.dot(point) / distance;
        if (approach < 0.1) continue;
        const double reached = normal.dot(m.middle) / approach;
        if (reached < 1.1 * distance + 0.3) continue;
        if (std::abs(tangent.dot(reached / distance * point - m.middle)) > m.half_length) continue;
        length += landmark.length() / samples;
        break;
      }
    }
  }
  return length;
}

ScanJudgement judge(const ScanEvidence& e) {
  ScanJudgement result;
  const double matched = length_of(e.pairs, e.measurements);
  const double total = length_of(e.measurements);
  // What the walls alone say of the position.
  Eigen::Matrix2d information = Eigen::Matrix2d::Zero();
  for (const auto& [i, k] : e.pairs) {
    const LineMeasurement& m = e.measurements[i];
    const Eigen::Vector2d normal = e.posterior.wall(e.map, k).normal();
    information += normal * normal.transpose() / m.covariance(1, 1);
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes(information);
  const bool weak = axes.eigenvalues()(0) * weak_position * weak_position < 1.0;
  if (weak) {
    const Eigen::Vector2d direction = axes.eigenvectors().col(0);
    result.weak_direction = direction_of(direction.x(), direction.y());
  }
  const bool lies_well = e.share > 0.6;
  const double refuted =
      lies_well ? 0.0
                : seen_through(e.posterior.pose, e.map, e.posterior.landmarks, e.measurements);
  const bool contradicted = e.share < least_share && matched < 0.5 * total &&
                            refuted > std::max({matched, 0.4 * total, least_refuted});
  // Neighbouring scans see the same walls.
  const bool fell = e.share < least_share || (!lies_well && e.share + largest_fall < e.last_share);
  const bool jumped = fell && matched < 0.5 * total && e.points > 20 &&
                      std::hypot(e.expected_step.x, e.expected_step.y) < short_step &&
                      std::abs(e.expected_step.theta) < short_turn;
  const bool blind = e.points < blind_points && e.pairs.empty();
  result.fits =
      !contradicted && !jumped && !blind && (e.has_odometry || e.share > 0.0 || !e.pairs.empty());
  if (!result.fits || weak || (matched < 0.5 * total && !lies_well) || refuted > matched) {
    result.status = LocalizationStatus::ambiguous;
  }
  return result;
}

void LossMonitor::add_fit(double stamp, bool well) {
  fitted_at_ = stamp;
  unfit_scans_ = 0;
  // Back where it should be, such as when what hid the walls has gone.
  back_scans_ = lost_ && well ? back_scans_ + 1 : 0;
  if (back_scans_ >= scans_back) lost_ = false;
}

bool LossMonitor::add_misfit(double stamp) {
  if (++unfit_scans_ < lost_scans || !(stamp - fitted_at_ > lost_after)) return false;
  const bool newly = !lost_;
  lost_ = true;
  back_scans_ = 0;
  return newly;
}

}  // namespace quoin
