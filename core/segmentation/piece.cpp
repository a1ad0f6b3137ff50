// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/segmentation/piece.hpp"

#include <algorithm>
#include <cmath>

namespace quoin {
namespace {

constexpr std::size_t left_out_at_ends = 3;

}  // namespace

InnerFit inner_fit(const InverseRangeSums& sums) {
  InnerFit fit;
  fit.sums = sums;
  if (const auto line = solve_inverse_line({sums.cc, sums.cs, sums.ss}, sums.cz, sums.sz)) {
    fit.a = line->q.x();
    fit.b = line->q.y();
    fit.norm = std::sqrt(fit.a * fit.a + fit.b * fit.b);
  }
  return fit;
}

NormalLine normal_line(const InnerFit& fit) {
  const double offset = 1.0 / fit.norm;
  return {fit.a * offset, fit.b * offset, offset};
}

std::size_t largest_gap(std::size_t min_points) {
  return 2 * std::max<std::size_t>(min_points, fewest_points + 1);
}

void drop_small(std::size_t min_points, std::vector<Piece>& pieces) {
  const std::size_t wanted = std::max<std::size_t>(min_points, fewest_points + 1);
  std::size_t kept = 0;
  bool joined = true;
  for (const Piece& candidate : pieces) {
    Piece piece = candidate;
    joined = joined && piece.joined;
    if (piece.segment.size() < wanted) continue;
    const std::size_t gap = kept > 0 ? piece.segment.begin - pieces[kept - 1].segment.end : 0;
    piece.joined = kept > 0 && joined && gap < largest_gap(min_points);
    pieces[kept++] = piece;
    joined = true;
  }
  pieces.resize(kept);
}

void fit_pieces(const PointsView& points, std::vector<Piece>& pieces) {
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const bool at_seam = i == 0 || i + 1 == pieces.size();
    if (!at_seam && !pieces[i].joined && !pieces[i + 1].joined) continue;
    const Segment& segment = pieces[i].segment;
    const std::size_t margin = std::min(left_out_at_ends, segment.size() / 4);
    pieces[i].fit =
        inner_fit(inverse_range_sums(points, segment.begin + margin, segment.end - margin));
  }
}

}  // namespace quoin
