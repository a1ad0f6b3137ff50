// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/evaluation/corner_matching.hpp"

#include <algorithm>
#include <tuple>

#include <Eigen/Core>

namespace quoin {
namespace {

/// Comparisons are written such that a NaN fails them.
bool within(const Eigen::Vector2d& difference, const Eigen::Matrix2d& covariance,
            const MatchingGate& gate) {
  if (!(difference.norm() <= gate.largest_distance)) return false;
  const double xx = covariance(0, 0);
  const double xy = covariance(0, 1);
  const double yy = covariance(1, 1);
  const double determinant = xx * yy - xy * xy;
  if (!(xx > 0.0 && determinant > 0.0)) return false;
  const double x = difference.x();
  const double y = difference.y();
  const double scaled = yy * x * x - 2.0 * xy * x * y + xx * y * y;
  return scaled <= gate.largest_mahalanobis_squared * determinant;
}

}  // namespace

std::vector<CornerMatch> match_corners(const std::vector<CornerEstimate>& first,
                                       const std::vector<CornerEstimate>& second,
                                       const MatchingGate& gate) {
  const std::size_t first_count = std::min(first.size(), most_matched);
  const std::size_t second_count = std::min(second.size(), most_matched);
  std::vector<CornerMatch> candidates;
  for (std::size_t i = 0; i < first_count; ++i) {
    for (std::size_t j = 0; j < second_count; ++j) {
      const Eigen::Vector2d difference = second[j].position - first[i].position;
      if (!within(difference, first[i].covariance + second[j].covariance, gate)) continue;
      candidates.push_back({i, j, difference.norm()});
    }
  }
  std::ranges::sort(candidates, {}, [](const CornerMatch& match) {
    return std::tuple(match.distance, match.first, match.second);
  });
  std::vector<bool> first_used(first_count);
  std::vector<bool> second_used(second_count);
  std::erase_if(candidates, [&](const CornerMatch& match) {
    if (first_used[match.first] || second_used[match.second]) return true;
    first_used[match.first] = true;
    second_used[match.second] = true;
    return false;
  });
  return candidates;
}

}  // namespace quoin
