// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/segmentation/merging.hpp"

#include <cstddef>
#include <limits>

namespace quoin {
namespace {

/// The line through two neighbours and how well it matches.
struct Match {
  InnerFit fit;
  double excess = std::numeric_limits<double>::infinity();  // of the worst point
};

Match match_of(const PointsView& points, const Piece& first, const Piece& second,
               const Tolerance& tolerance) {
  Match match;
  if (!second.joined || !(first.fit.norm > 0.0) || !(second.fit.norm > 0.0)) return match;
  // The outer end of the shorter piece tells cheaply: it is far from the other wall at a corner.
  const bool first_is_longer = first.segment.size() >= second.segment.size();
  const InnerFit& longer = first_is_longer ? first.fit : second.fit;
  const std::size_t outer = first_is_longer ? second.segment.end - 1 : first.segment.begin;
  if (is_beyond(normal_line(longer), points, outer, tolerance)) return match;

  InverseRangeSums sums = first.fit.sums;
  sums += second.fit.sums;
  match.fit = inner_fit(sums);
  if (!(match.fit.norm > 0.0)) return match;
  const PointsView both = points.subview(first.segment.begin, second.segment.end);
  const FarthestPoint farthest = farthest_from(normal_line(match.fit), both, tolerance);
  if (!farthest.beyond()) match.excess = farthest.excess;
  return match;
}

}  // namespace

void merge_collinear(const PointsView& points, const Tolerance& tolerance,
                     std::vector<Piece>& pieces) {
  while (true) {
    Match best;
    std::size_t second = 0;
    for (std::size_t i = 1; i < pieces.size(); ++i) {
      const Match match = match_of(points, pieces[i - 1], pieces[i], tolerance);
      if (match.excess < best.excess) {
        best = match;
        second = i;
      }
    }
    if (second == 0) return;
    pieces[second - 1].segment.end = pieces[second].segment.end;
    pieces[second - 1].fit = best.fit;
    pieces.erase(pieces.begin() + static_cast<std::ptrdiff_t>(second));
  }
}

}  // namespace quoin
