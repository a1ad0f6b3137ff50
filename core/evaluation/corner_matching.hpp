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

/// No scan has more corners; lists that come from outside may.
inline constexpr std::size_t most_matched = 1024;

}  // namespace quoin
