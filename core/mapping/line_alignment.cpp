// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/mapping/line_alignment.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include <Eigen/Cholesky>

#include "core/geometry/angle.hpp"

namespace quoin {
namespace {

constexpr double least_crossing = 0.35;    // [rad] of two walls that give a position
constexpr std::size_t most_first = 8;      // longest segments of the first set in pairs
constexpr double distinct_distance = 0.3;  // [m]
constexpr double distinct_turn = 10.0 * pi / 180.0;
constexpr std::size_t most_hypotheses = 200;  // refined

Eigen::Vector2d unit(double direction) { return {std::cos(direction), std::sin(direction)}; }

/// Length [m] of a segment that lies on another one, both nearly parallel.
double shared_length(const Eigen::Vector2d& middle, double half, const SidedSegment& other) {
  const Eigen::Vector2d along = unit(other.normal + 0.5 * pi);
  const double at = along.dot(middle - other.middle);
  return std::min(at + half, other.half_length) - std::max(at - half, -other.half_length);
}

void score(std::span<const SidedSegment> first, std::span<const SidedSegment> second,
           const AlignmentSearch& search, Alignment& alignment) {
  alignment.support = 0.0;
  alignment.pairs.clear();
  for (std::size_t i = 0; i < first.size(); ++i) {
    const Eigen::Vector2d middle = alignment.pose.transform(first[i].middle);
    const double normal = alignment.pose.theta + first[i].normal;
    double best = 0.0;
    std::size_t partner = 0;
    for (std::size_t k = 0; k < second.size(); ++k) {
      const SidedSegment& other = second[k];
      const double reach = first[i].half_length + other.half_length;
      if ((middle - other.middle).squaredNorm() > (reach + 1.0) * (reach + 1.0)) continue;
      const double turn = normalized_angle(normal - other.normal) / search.angle_tolerance;
      if (std::abs(turn) >= 1.0) continue;
      const double off = unit(other.normal).dot(middle - other.middle) / search.offset_tolerance;
      if (std::abs(off) >= 1.0) continue;
      const double value = shared_length(middle, first[i].half_length, other) *
                           (1.0 - turn * turn) * (1.0 - off * off);
      if (value > best) {
        best = value;
        partner = k;
      }
    }
    if (best <= 0.0) continue;
    alignment.support += best;
    alignment.pairs.emplace_back(i, partner);
  }
}

/// Moves the pose to the least squares of the pairs, weighted with their lengths.
void refine(std::span<const SidedSegment> first, std::span<const SidedSegment> second,
            const AlignmentSearch& search, Alignment& alignment) {
  Eigen::Matrix3d information = 1e-6 * Eigen::Matrix3d::Identity();
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
  for (const auto& [i, k] : alignment.pairs) {
    const Eigen::Vector2d middle = alignment.pose.transform(first[i].middle);
    const Eigen::Vector2d normal = unit(second[k].normal);
    const Eigen::Vector2d lever(-(middle.y() - alignment.pose.y), middle.x() - alignment.pose.x);
    const Eigen::Vector3d by_pose(normal.x(), normal.y(), normal.dot(lever));
    const double off = normal.dot(middle - second[k].middle);
    const double turn = normalized_angle(alignment.pose.theta + first[i].normal - second[k].normal);
    const double weight = std::min(first[i].half_length, second[k].half_length);
    const double angular = search.offset_tolerance / search.angle_tolerance;
    information += weight * by_pose * by_pose.transpose();
    gradient += weight * off * by_pose;
    information(2, 2) += weight * angular * angular;
    gradient(2) += weight * angular * angular * turn;
  }
  const Eigen::Vector3d change = -information.ldlt().solve(gradient);
  if (!change.allFinite()) return;
  alignment.pose.x += change.x();
  alignment.pose.y += change.y();
  alignment.pose.theta = normalized_angle(alignment.pose.theta + change.z());
}

bool is_inside(const Pose2& pose, const AlignmentSearch& search) {
  const double turn = std::abs(normalized_angle(pose.theta - search.center.theta));
  const double allowed = search.largest_translation + search.pivot * std::min(turn, 1.0);
  return turn <= search.largest_turn && std::abs(pose.x - search.center.x) <= allowed &&
         std::abs(pose.y - search.center.y) <= allowed;
}

}  // namespace

std::vector<Alignment> align(std::span<const SidedSegment> first,
                             std::span<const SidedSegment> second, const AlignmentSearch& search,
                             std::size_t count) {
  std::vector<std::size_t> longest(first.size());
  std::iota(longest.begin(), longest.end(), std::size_t{0});
  std::stable_sort(longest.begin(), longest.end(), [&](std::size_t a, std::size_t b) {
    return first[a].half_length > first[b].half_length;
  });
  longest.resize(std::min(longest.size(), most_first));

  struct Hypothesis {
    Pose2 pose;
    double length;
  };
  std::vector<Hypothesis> hypotheses;
  for (std::size_t a = 0; a < longest.size(); ++a) {
    for (std::size_t b = a + 1; b < longest.size(); ++b) {
      const SidedSegment& p = first[longest[a]];
      const SidedSegment& q = first[longest[b]];
      const double crossing = normalized_angle(q.normal - p.normal);
      if (std::abs(std::sin(crossing)) < std::sin(least_crossing)) continue;
      for (const SidedSegment& r : second) {
        const double turn = normalized_angle(r.normal - p.normal);
        if (std::abs(normalized_angle(turn - search.center.theta)) >
            search.largest_turn + search.angle_tolerance) {
          continue;
        }
        const double reach =
            (p.middle - q.middle).norm() + p.half_length + q.half_length + r.half_length;
        for (const SidedSegment& s : second) {
          const double excess = normalized_angle(s.normal - r.normal - crossing);
          if (std::abs(excess) > search.angle_tolerance) continue;
          if ((s.middle - r.middle).norm() > reach + s.half_length) continue;
          Pose2 pose{0.0, 0.0, normalized_angle(turn + 0.5 * excess)};
          const Eigen::Vector2d n1 = unit(r.normal);
          const Eigen::Vector2d n2 = unit(s.normal);
          const double o1 = n1.dot(r.middle - pose.transform(p.middle));
          const double o2 = n2.dot(s.middle - pose.transform(q.middle));
          const double determinant = n1.x() * n2.y() - n1.y() * n2.x();
          if (std::abs(determinant) < 0.2) continue;
          pose.x = (o1 * n2.y() - o2 * n1.y()) / determinant;
          pose.y = (o2 * n1.x() - o1 * n2.x()) / determinant;
          if (!is_inside(pose, search)) continue;
          const double on_r = shared_length(pose.transform(p.middle), p.half_length, r);
          const double on_s = shared_length(pose.transform(q.middle), q.half_length, s);
          if (on_r < 0.5 * std::min(p.half_length, r.half_length) ||
              on_s < 0.5 * std::min(q.half_length, s.half_length)) {
            continue;
          }
          hypotheses.push_back({pose, on_r + on_s});
        }
      }
    }
  }
  // The same pose comes from many pairs: it is looked at once, and its lengths are summed.
  std::vector<Hypothesis> distinct;
  for (const Hypothesis& hypothesis : hypotheses) {
    const auto same = std::find_if(distinct.begin(), distinct.end(), [&](const Hypothesis& other) {
      return std::abs(hypothesis.pose.x - other.pose.x) < 0.5 * distinct_distance &&
             std::abs(hypothesis.pose.y - other.pose.y) < 0.5 * distinct_distance &&
             std::abs(normalized_angle(hypothesis.pose.theta - other.pose.theta)) <
                 0.5 * distinct_turn;
    });
    if (same == distinct.end()) {
      distinct.push_back(hypothesis);
    } else {
      same->length += hypothesis.length;
    }
  }
  std::stable_sort(distinct.begin(), distinct.end(),
                   [](const Hypothesis& a, const Hypothesis& b) { return a.length > b.length; });
  distinct.resize(std::min(distinct.size(), most_hypotheses));

  std::vector<Alignment> found;
  for (const Hypothesis& hypothesis : distinct) {
    Alignment alignment{hypothesis.pose, 0.0, {}};
    score(first, second, search, alignment);
    for (int i = 0; i < 2; ++i) {
      refine(first, second, search, alignment);
      score(first, second, search, alignment);
    }
    if (alignment.support > 0.0 && is_inside(alignment.pose, search)) found.push_back(alignment);
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const Alignment& a, const Alignment& b) { return a.support > b.support; });
  std::vector<Alignment> best;
  for (Alignment& alignment : found) {
    if (best.size() == count) break;
    const bool near = std::any_of(best.begin(), best.end(), [&](const Alignment& other) {
      return std::hypot(alignment.pose.x - other.pose.x, alignment.pose.y - other.pose.y) <
                 distinct_distance &&
             std::abs(normalized_angle(alignment.pose.theta - other.pose.theta)) < distinct_turn;
    });
    if (!near) best.push_back(std::move(alignment));
  }
  return best;
}

}  // namespace quoin
