// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "core/geometry/corner.hpp"

namespace quoin {

/// When two estimates may be of the same corner.
struct MatchingGate {
  double largest_distance = 0.2;  ///< [m]
  /// Of the difference in the sum of both covariances; -2 ln(0.001), which one in a thousand
  /// independent pairs exceeds.
  double largest_mahalanobis_squared = 13.815510557964274;
};

struct CornerMatch {
  std::size_t first = 0;   ///< index into the first list
  std::size_t second = 0;  ///< index into the second list
  double distance = 0.0;   ///< [m]
};

/// Pairs of estimates of the same corner: each is used once, the closest pair first. A pair whose
/// covariances sum to a matrix that is not positive definite, or not finite, is none. At most
/// `most_matched` of each list are looked at.
[[nodiscard]] std::vector<CornerMatch> match_corners(const std::vector<CornerEstimate>& first,
                                                     const std::vector<CornerEstimate>& second,
                                                     const MatchingGate& gate);

/// Squared Mahalanobis distance of four standard deviations; one true pair in 3000 is beyond.
inline constexpr double four_sigma_squared = 16.0;

/// A found corner and the true one that it is of.
struct TruthMatch {
  std::size_t found = 0;             ///< index into the found ones
  std::size_t truth = 0;             ///< index into the true ones
  double mahalanobis_squared = 0.0;  ///< of the error, +inf when the covariance is none
};

/// Which found corner is of which true one [m]: the one matching behind all figures of recall,
/// precision and coverage. A found corner may be of a true one within 15 cm, whatever its
/// covariance says, and of one within 1 m that is inside its four-sigma ellipse. Each is used once,
/// the closest pair first; a found corner without a match is false.
[[nodiscard]] std::vector<TruthMatch> match_truth(const std::vector<CornerEstimate>& found,
                                                  const std::vector<Eigen::Vector2d>& truth);

/// No scan has more corners; lists that come from outside may.
inline constexpr std::size_t most_matched = 1024;

}  // namespace quoin
