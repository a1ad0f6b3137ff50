// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/segmentation/refinement.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace quoin {
namespace {

constexpr double parallel_sine = 0.05;  // lines that meet at less than 3 deg have no corner
// How far, in tolerances, the corner may be from the nearest ends of its two pieces.
constexpr double reach = 4.0;

struct Intersection {
  double x, y;  // [m]
};

/// The corner of two neighbouring pieces, or nothing when there is none near.
std::optional<Intersection> corner_of(const PointsView& points, const Piece& first,
                                      const Piece& second, const Tolerance& tolerance) {
  if (!(first.fit.norm > 0.0) || !(second.fit.norm > 0.0)) return std::nullopt;
  const double cross = first.fit.a * second.fit.b - first.fit.b * second.fit.a;
  if (std::abs(cross) <= parallel_sine * first.fit.norm * second.fit.norm) return std::nullopt;
  const Intersection p{(second.fit.b - first.fit.b) / cross, (first.fit.a - second.fit.a) / cross};
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

/// For a few points: those that a boundary is moved over.
bool all_near(const PointsView& points, const Segment& segment, const InnerFit& fit,
              const Tolerance& tolerance) {
  if (segment.begin >= segment.end) return true;
  const NormalLine line = normal_line(fit);
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
  if (!all_near(points, to_first, first.fit, tolerance)) return;
  if (!all_near(points, to_second, second.fit, tolerance)) return;
  first.segment.end = boundary;
  second.segment.begin = boundary;
  if (first.segment.size() > min_points) --first.segment.end;
  if (second.segment.size() > min_points) ++second.segment.begin;
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
}

}  // namespace

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
