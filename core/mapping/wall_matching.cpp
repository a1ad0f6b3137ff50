// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/mapping/wall_matching.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include "core/geometry/angle.hpp"
#include "core/mapping/line_alignment.hpp"
#include "core/mapping/line_gates.hpp"

namespace quoin {
namespace {

constexpr double wide_factor = 4.0;    // where nothing else fits
constexpr double motion_gate = 16.27;  // chi square of 3, 99.9 %

SidedSegment sided(const LineMeasurement& m) { return {m.alpha, m.middle, m.half_length}; }
SidedSegment sided(const LineLandmark& l) {
  return {l.phi, l.at(0.5 * (l.low + l.high)), 0.5 * l.length()};
}

}  // namespace

double length_of(const WallPairs& pairs, std::span<const LineMeasurement> measurements) {
  double length = 0.0;
  for (const auto& pair : pairs) length += 2.0 * measurements[pair.first].half_length;
  return length;
}

double length_of(std::span<const LineMeasurement> measurements) {
  double length = 0.0;
  for (const LineMeasurement& m : measurements) length += 2.0 * m.half_length;
  return length;
}

/// One line after the other, the longest first; each one that is taken narrows the gates of the
/// others. A line that two walls explain about as well waits until the rest has been taken.
WallPairs WallMatching::one_by_one(WallBelief belief, double direction_stddev,
                                   double offset_stddev) const {
  WallPairs pairs;
  std::vector<std::size_t> waiting(s_.measurements.size());
  for (std::size_t i = 0; i < waiting.size(); ++i) waiting[i] = i;
  std::stable_sort(waiting.begin(), waiting.end(), [&](std::size_t a, std::size_t b) {
    return s_.measurements[a].half_length > s_.measurements[b].half_length;
  });
  for (int pass = 0; pass < 3 && !waiting.empty(); ++pass) {
    std::vector<std::size_t> left;
    for (const std::size_t i : waiting) {
      const LineMeasurement& m = s_.measurements[i];
      double best = std::numeric_limits<double>::infinity();
      double second = best;
      std::size_t place = 0;
      const double position_stddev = std::min(
          0.25, std::sqrt(std::max(s_.search_covariance(0, 0), s_.search_covariance(1, 1))));
      for (std::size_t k = 0; k < belief.walls.size(); ++k) {
        const LineLandmark landmark = belief.wall(s_.map, k);
        if (std::cos(belief.pose.theta + m.alpha - landmark.phi) < 0.8) continue;
        if (!lies_on(belief.pose, landmark, m, position_stddev)) continue;
        const LineResidual residual = line_residual(belief.pose, landmark, m);
        const Eigen::Matrix2d s =
            innovation_covariance(residual, belief.covariance, k, m.covariance);
        if (s(0, 0) > direction_stddev * direction_stddev ||
            s(1, 1) > offset_stddev * offset_stddev) {
          continue;
        }
        const double squared = residual.value.dot(s.inverse() * residual.value);
        if (squared > line_gate) continue;
        const double value = squared + std::log(s.determinant());
        if (value < best) {
          second = best;
          best = value;
          place = k;
        } else {
          second = std::min(second, value);
        }
      }
      if (!std::isfinite(best)) continue;
      if (second - best < 4.0 && pass < 2) {
        left.push_back(i);
        continue;
      }
      if (second - best < 1.0) continue;  // either would be a guess
      pairs.emplace_back(i, place);
      update_with(belief, s_.map, place, m);
    }
    waiting = std::move(left);
  }
  return pairs;
}

/// All lines together, where the pose is too uncertain for one at a time.
WallMatching::Result WallMatching::all_together(const WallBelief& belief) const {
  std::vector<SidedSegment> first, second;
  for (const LineMeasurement& m : s_.measurements) first.push_back(sided(m));
  for (std::size_t k = 0; k < belief.walls.size(); ++k)
    second.push_back(sided(belief.wall(s_.map, k)));
  AlignmentSearch search;
  search.center = belief.pose;
  // Relative to the walls seen last: what the motion adds.
  const Eigen::Matrix3d& c = s_.search_covariance;
  // Motion that slips is farther off than its covariance says.
  search.largest_translation =
      std::clamp(0.1 + 3.5 * std::sqrt(std::max(c(0, 0), c(1, 1))), 0.4, 1.5);
  search.largest_turn = std::clamp(0.05 + 3.5 * std::sqrt(c(2, 2)), 0.4, 0.8);
  const std::vector<Alignment> found = align(first, second, search);
  if (found.empty() || found.front().pairs.size() < 3) return {};
  if (found.size() > 1 && found[1].support > 0.8 * found[0].support) return {};
  // The motion counts less where the walls refute it.
  const Pose2 step = between(s_.base.pose, found.front().pose);
  const Eigen::Vector3d off(step.x - s_.since.pose.x, step.y - s_.since.pose.y,
                            normalized_angle(step.theta - s_.since.pose.theta));
  const Eigen::Matrix3d& s = s_.since.covariance;
  const double squared = off.dot(s.ldlt().solve(off));
  const double weakening = squared > 3.0 ? squared / 3.0 : 1.0;
  // Put elsewhere, a robot finds walls that look alike: nearly all of the scan has to fit.
  if (squared > motion_gate && found.front().support < 0.7 * length_of(s_.measurements)) return {};
  return {found.front().pairs, weakening};
}

WallMatching::Result WallMatching::find() const {
  const WallBelief prior = predict(s_.base, {s_.moved, s_.search_covariance});
  const double half = 0.5 * length_of(s_.measurements);
  const auto length = [this](const WallPairs& pairs) { return length_of(pairs, s_.measurements); };
  Result best{one_by_one(prior, widest_direction, widest_offset)};
  const auto improve = [&](Result found) {
    WallBelief posterior;
    const WallBelief from =
        found.weakening > 1.0 ? predict(s_.base, {s_.moved, found.weakening * s_.search_covariance})
                              : prior;
    if (found.pairs.empty() ||
        !update_with(from, s_.map, s_.measurements, found.pairs, posterior)) {
      return;
    }
    WallPairs again = one_by_one(posterior, widest_direction, widest_offset);
    if (length(again) > length(found.pairs)) found.pairs = std::move(again);
    if (length(found.pairs) > 1.2 * length(best.pairs)) best = std::move(found);
  };
  if (length(best.pairs) < half) improve(all_together(prior));
  if (length(best.pairs) < half) {
    improve({one_by_one(prior, wide_factor * widest_direction, wide_factor * widest_offset)});
  }
  return best;
}

}  // namespace quoin
