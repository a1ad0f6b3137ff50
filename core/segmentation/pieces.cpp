// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/segmentation/pieces.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/fitting/algebraic.hpp"

namespace quoin {
namespace {

constexpr std::size_t left_out_at_ends = 3;

/// Of the points of a segment but for those at its ends.
Moments inner_moments(const PointsView& points, const Segment& segment) {
  const std::size_t margin = std::min(left_out_at_ends, segment.size() / 4);
  return inverse_range_moments(points, segment.begin + margin, segment.end - margin);
}

constexpr double parallel_sine = 0.05;  // lines that meet at less than 3 deg have no corner
// How far, in tolerances, the corner may be from the nearest ends of its two pieces.
constexpr double reach = 4.0;

struct Intersection {
  double x, y;            // [m]
  double spread_squared;  // [m^2] along the walls, of two standard deviations
};

/// The corner of two neighbouring pieces, or nothing when there is none near.
std::optional<Intersection> corner_of(const PointsView& points, const Piece& first,
                                      const Piece& second, const Tolerance& tolerance) {
  if (!first.line || !second.line) return std::nullopt;
  const NormalLine& a = *first.line;
  const NormalLine& b = *second.line;
  const double sine = a.normal_x * b.normal_y - a.normal_y * b.normal_x;
  if (std::abs(sine) <= parallel_sine) return std::nullopt;
  // At its end a line is off by twice the standard deviation of the mean of its points.
  const double means = 1.0 / static_cast<double>(first.segment.size()) +
                       1.0 / static_cast<double>(second.segment.size());
  const double deviations = 4.0 / deviations_in_tolerance;
  const Intersection p{(a.offset * b.normal_y - b.offset * a.normal_y) / sine,
                       (b.offset * a.normal_x - a.offset * b.normal_x) / sine,
                       deviations * deviations * tolerance.range * means / (sine * sine)};
  const auto near = [&](std::size_t i) {
    const double dx = points.x[i] - p.x;
    const double dy = points.y[i] - p.y;
    return dx * dx + dy * dy <= reach * reach * tolerance.largest;
  };
  if (!near(first.segment.end - 1) && !near(second.segment.begin)) return std::nullopt;
  return p;
}

/// Positive while point `i` comes before the direction of `p`.
double before(const PointsView& points, std::size_t i, const Intersection& p) {
  return points.cosine[i] * p.y - points.sine[i] * p.x;
}

/// Whether noise decides on which wall the point at the end of a piece seems to be.
bool is_undecided(const PointsView& points, std::size_t i, const Intersection& p) {
  const double dx = points.x[i] - p.x;
  const double dy = points.y[i] - p.y;
  return dx * dx + dy * dy < p.spread_squared;
}

/// For a few points: those that a boundary is moved over.
bool all_near(const PointsView& points, const Segment& segment, const NormalLine& line,
              const Tolerance& tolerance) {
  for (std::size_t i = segment.begin; i < segment.end; ++i) {
    if (is_beyond(line, points, i, tolerance)) return false;
  }
  return true;
}

/// Moves the boundary between two pieces to the corner of their lines.
void move_boundary(const PointsView& points, std::size_t min_points, const Tolerance& tolerance,
                   Piece& first, Piece& second) {
  const auto p = corner_of(points, first, second, tolerance);
  if (!p) return;
  const std::size_t lowest = first.segment.begin + fewest_points;
  const std::size_t highest = second.segment.end - fewest_points;
  std::size_t boundary = first.segment.end;
  while (boundary > lowest && before(points, boundary - 1, *p) <= 0.0) --boundary;
  while (boundary < highest && before(points, boundary, *p) > 0.0) ++boundary;
  // At the limit the corner is somewhere else; the pieces are better left alone.
  if (boundary <= lowest || boundary >= highest) return;
  const Segment to_first{std::min(first.segment.end, boundary), boundary};
  const Segment to_second{boundary, std::max(second.segment.begin, boundary)};
  if (!all_near(points, to_first, *first.line, tolerance)) return;
  if (!all_near(points, to_second, *second.line, tolerance)) return;
  first.segment.end = boundary;
  second.segment.begin = boundary;
  Segment& a = first.segment;
  Segment& b = second.segment;
  if (a.size() > min_points) --a.end;
  if (b.size() > min_points) ++b.begin;
  while (a.size() > min_points && is_undecided(points, a.end - 1, *p)) --a.end;
  while (b.size() > min_points && is_undecided(points, b.begin, *p)) ++b.begin;
  first.ends_at_corner = true;
  second.begins_at_corner = true;
}

/// Leaves out what lies beyond the corner across the seam, and the point nearest to it on either
/// side.
void trim_at_seam(const PointsView& points, const Tolerance& tolerance, Piece& last, Piece& first) {
  const auto p = corner_of(points, last, first, tolerance);
  if (!p) return;
  std::size_t& end = last.segment.end;
  std::size_t& begin = first.segment.begin;
  const std::size_t lowest = last.segment.begin + fewest_points;
  const std::size_t highest = first.segment.end - fewest_points;
  while (end > lowest && before(points, end - 1, *p) <= 0.0) --end;
  while (begin < highest && before(points, begin, *p) > 0.0) ++begin;
  if (end > lowest) --end;
  if (begin < highest) ++begin;
  last.ends_at_corner = true;
  first.begins_at_corner = true;
}

}  // namespace

std::size_t largest_gap(std::size_t min_points) {
  return 2 * std::max<std::size_t>(min_points, fewest_points + 1);
}

void drop_small(std::size_t fewest, std::size_t min_points, std::vector<Piece>& pieces) {
  const std::size_t wanted = std::max<std::size_t>(fewest, fewest_points + 1);
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

std::optional<NormalLine> line_of(const Moments& moments) {
  const auto solution = solve_algebraic(moments);
  if (!solution || !(solution->x.squaredNorm() > 0.0)) return std::nullopt;
  return normal_line(solution->x);
}

void fit_pieces(const PointsView& points, std::vector<Piece>& pieces) {
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    if (pieces[i].round || pieces[i].line) continue;
    const bool at_seam = i == 0 || i + 1 == pieces.size();
    if (!at_seam && !pieces[i].joined && !pieces[i + 1].joined) continue;
    pieces[i].moments = inner_moments(points, pieces[i].segment);
    pieces[i].line = line_of(pieces[i].moments);
  }
}

void refine_boundaries(const PointsView& points, std::size_t min_points, const Tolerance& tolerance,
                       bool closed, std::vector<Piece>& pieces) {
  if (pieces.size() < 2) return;
  for (std::size_t i = 1; i < pieces.size(); ++i) {
    if (pieces[i].joined) move_boundary(points, min_points, tolerance, pieces[i - 1], pieces[i]);
  }
  const std::size_t near_seam = largest_gap(min_points) / 2;
  const bool reaches_seam = pieces.front().segment.begin < near_seam &&
                            pieces.back().segment.end + near_seam > points.size();
  if (closed && reaches_seam) trim_at_seam(points, tolerance, pieces.back(), pieces.front());
}

}  // namespace quoin
