// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/evaluation/corner_matching.hpp"

#include <algorithm>
#include <limits>
#include <tuple>

#include <Eigen/Core>

namespace quoin {
namespace {

constexpr double near_truth = 0.15;     // [m]
constexpr double farthest_truth = 1.0;  // [m]

/// +inf for a covariance that is not positive definite. Comparisons are written such that a NaN
/// fails them.
double mahalanobis_squared(const Eigen::Vector2d& difference, const Eigen::Matrix2d& covariance) {
  const double xx = covariance(0, 0);
  const double xy = covariance(0, 1);
  const double yy = covariance(1, 1);
  const double determinant = xx * yy - xy * xy;
  if (!(xx > 0.0 && determinant > 0.0)) return std::numeric_limits<double>::infinity();
  const double x = difference.x();
  const double y = difference.y();
  return (yy * x * x - 2.0 * xy * x * y + xx * y * y) / determinant;
}

/// Leaves each index of either list in one pair, the closest pair first.
void use_once(std::vector<CornerMatch>& candidates, std::size_t first_count,
              std::size_t second_count) {
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
      const double distance = difference.norm();
      if (!(distance <= gate.largest_distance)) continue;
      if (!(mahalanobis_squared(difference, first[i].covariance + second[j].covariance) <=
            gate.largest_mahalanobis_squared)) {
        continue;
      }
      candidates.push_back({i, j, distance});
    }
  }
  use_once(candidates, first_count, second_count);
  return candidates;
}

std::vector<TruthMatch> match_truth(const std::vector<CornerEstimate>& found,
                                    const std::vector<Eigen::Vector2d>& truth) {
  std::vector<CornerMatch> candidates;
  for (std::size_t i = 0; i < found.size(); ++i) {
    for (std::size_t k = 0; k < truth.size(); ++k) {
      const Eigen::Vector2d error = found[i].position - truth[k];
      const double distance = error.norm();
      if (!(distance <= farthest_truth)) continue;
      const bool near = distance <= near_truth ||
                        mahalanobis_squared(error, found[i].covariance) <= four_sigma_squared;
      if (near) candidates.push_back({i, k, distance});
    }
  }
  use_once(candidates, found.size(), truth.size());
  std::vector<TruthMatch> matches;
  for (const CornerMatch& match : candidates) {
    const CornerEstimate& corner = found[match.first];
    matches.push_back(
        {match.first, match.second,
         mahalanobis_squared(corner.position - truth[match.second], corner.covariance)});
  }
  return matches;
}

}  // namespace quoin
