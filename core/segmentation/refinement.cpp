// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/segmentation/refinement.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <span>

#include "core/segmentation/chord.hpp"

namespace quoin {
namespace {

constexpr std::size_t left_out_at_ends = 3;  // points near a vertex may be on the other wall
constexpr std::size_t fewest = 3;            // points that a piece keeps; its user may want more
constexpr double parallel_sine = 0.05;       // lines that meet at less than 3 deg have no corner
// How far, in tolerances, the corner may be from the nearest ends of its two pieces.
constexpr double reach = 4.0;

InnerFit fit_of(const InverseRangeSums& sums) {
  InnerFit fit;
  fit.sums = sums;
  if (const auto line = solve_inverse_line({sums.cc, sums.cs, sums.ss}, sums.cz, sums.sz)) {
    fit.a = line->q.x();
    fit.b = line->q.y();
    fit.norm = std::sqrt(fit.a * fit.a + fit.b * fit.b);
  }
  return fit;
}

InnerFit fit_inner(const PointsView& points, const Segment& segment) {
  const std::size_t margin = std::min(left_out_at_ends, segment.size() / 4);
  return fit_of(inverse_range_sums(points.subview(segment.begin + margin, segment.end - margin)));
}

double distance_of_farthest(const PointsView& points, const Segment& segment, const InnerFit& fit) {
  if (segment.begin >= segment.end) return 0.0;
  return largest_distance(points.x.subspan(segment.begin, segment.size()),
                          points.y.subspan(segment.begin, segment.size()), fit.a / fit.norm,
                          fit.b / fit.norm, 1.0 / fit.norm);
}

/// The line through two neighbours and how well it matches.
struct Match {
  InnerFit fit;
  double distance = std::numeric_limits<double>::infinity();  // [m] of the worst point
};

Match match_of(const PointsView& points, const Piece& first, const Piece& second,
               double tolerance) {
  Match match;
  if (!second.joined || !(first.fit.norm > 0.0) || !(second.fit.norm > 0.0)) return match;
  // The outer end of the shorter piece tells cheaply: it is far from the other wall at a corner.
  const bool first_is_longer = first.segment.size() >= second.segment.size();
  const InnerFit& longer = first_is_longer ? first.fit : second.fit;
  const std::size_t outer = first_is_longer ? second.segment.end - 1 : first.segment.begin;
  const double offset = longer.a * points.x[outer] + longer.b * points.y[outer] - 1.0;
  if (!(std::abs(offset) <= tolerance * longer.norm)) return match;

  InverseRangeSums sums = first.fit.sums;
  sums += second.fit.sums;
  match.fit = fit_of(sums);
  if (!(match.fit.norm > 0.0)) return match;
  const double distance =
      distance_of_farthest(points, {first.segment.begin, second.segment.end}, match.fit);
  if (distance <= tolerance) match.distance = distance;
  return match;
}

/// Joins neighbours that are one wall, the best match first: a short piece may suit both sides.
void join_collinear(const PointsView& points, double tolerance, std::vector<Piece>& pieces) {
  while (true) {
    Match best;
    std::size_t second = 0;
    for (std::size_t i = 1; i < pieces.size(); ++i) {
      const Match match = match_of(points, pieces[i - 1], pieces[i], tolerance);
      if (match.distance < best.distance) {
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

struct Intersection {
  double x, y;  // [m]
};

/// The corner of two neighbouring pieces, or nothing when there is none near.
std::optional<Intersection> corner_of(const PointsView& points, const Piece& first,
                                      const Piece& second, double tolerance) {
  if (!(first.fit.norm > 0.0) || !(second.fit.norm > 0.0)) return std::nullopt;
  const double cross = first.fit.a * second.fit.b - first.fit.b * second.fit.a;
  if (std::abs(cross) <= parallel_sine * first.fit.norm * second.fit.norm) return std::nullopt;
  const Intersection p{(second.fit.b - first.fit.b) / cross, (first.fit.a - second.fit.a) / cross};
  const auto near = [&](std::size_t i) {
    const double dx = points.x[i] - p.x;
    const double dy = points.y[i] - p.y;
    return dx * dx + dy * dy <= reach * reach * tolerance * tolerance;
  };
  if (!near(first.segment.end - 1) && !near(second.segment.begin)) return std::nullopt;
  return p;
}

/// Positive while point `i` comes before the direction of `p`.
double before(const PointsView& points, std::size_t i, const Intersection& p) {
  return points.cosine[i] * p.y - points.sine[i] * p.x;
}

/// Moves the boundary between two pieces to the corner of their lines.
void move_boundary(const PointsView& points, std::size_t min_points, double tolerance, Piece& first,
                   Piece& second) {
  const auto p = corner_of(points, first, second, tolerance);
  if (!p) return;
  const std::size_t lowest = first.segment.begin + fewest;
  const std::size_t highest = second.segment.end - fewest;
  std::size_t boundary = first.segment.end;
  while (boundary > lowest && before(points, boundary - 1, *p) <= 0.0) --boundary;
  while (boundary < highest && before(points, boundary, *p) > 0.0) ++boundary;
  // At the limit the corner is somewhere else; the pieces are better left alone.
  if (boundary <= lowest || boundary >= highest) return;
  const Segment to_first{std::min(first.segment.end, boundary), boundary};
  const Segment to_second{boundary, std::max(second.segment.begin, boundary)};
  if (distance_of_farthest(points, to_first, first.fit) > tolerance) return;
  if (distance_of_farthest(points, to_second, second.fit) > tolerance) return;
  first.segment.end = boundary;
  second.segment.begin = boundary;
  if (first.segment.size() > min_points) --first.segment.end;
  if (second.segment.size() > min_points) ++second.segment.begin;
}

/// Leaves out what lies beyond the corner across the seam, and the point nearest to it on either
/// side.
void trim_at_seam(const PointsView& points, double tolerance, Piece& last, Piece& first) {
  const auto p = corner_of(points, last, first, tolerance);
  if (!p) return;
  std::size_t& end = last.segment.end;
  std::size_t& begin = first.segment.begin;
  const std::size_t lowest = last.segment.begin + fewest;
  const std::size_t highest = first.segment.end - fewest;
  while (end > lowest && before(points, end - 1, *p) <= 0.0) --end;
  while (begin < highest && before(points, begin, *p) > 0.0) ++begin;
  if (end > lowest) --end;
  if (begin < highest) ++begin;
}

/// Drops pieces of fewer than `wanted` points. The neighbours of what is dropped become neighbours,
/// unless a break of the surface is between them.
void drop_small(std::size_t wanted, std::vector<Piece>& pieces) {
  std::size_t kept = 0;
  bool joined = true;
  for (const Piece& candidate : pieces) {
    Piece piece = candidate;
    joined = joined && piece.joined;
    if (piece.segment.size() < wanted) continue;
    const std::size_t gap = kept > 0 ? piece.segment.begin - pieces[kept - 1].segment.end : 0;
    piece.joined = kept > 0 && joined && gap < 2 * wanted;
    pieces[kept++] = piece;
    joined = true;
  }
  pieces.resize(kept);
}

}  // namespace

void refine(const PointsView& points, std::size_t min_points, double tolerance, bool closed,
            std::vector<Piece>& pieces) {
  const std::size_t wanted = std::max<std::size_t>(min_points, fewest + 1);
  drop_small(wanted, pieces);
  if (pieces.empty()) return;
  for (Piece& piece : pieces) piece.fit = fit_inner(points, piece.segment);
  join_collinear(points, tolerance, pieces);
  for (std::size_t i = 1; i < pieces.size(); ++i) {
    if (pieces[i].joined) move_boundary(points, min_points, tolerance, pieces[i - 1], pieces[i]);
  }
  const bool reaches_seam =
      pieces.front().segment.begin < wanted && pieces.back().segment.end + wanted > points.size();
  if (closed && reaches_seam && pieces.size() > 1) {
    trim_at_seam(points, tolerance, pieces.back(), pieces.front());
  }
}

}  // namespace quoin
