// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/segmentation/pieces.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>
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

std::optional<NormalLine> line_of(const Moments& moments) {
  const auto solution = solve_algebraic(moments);
  if (!solution || !(solution->x.squaredNorm() > 0.0)) return std::nullopt;
  return normal_line(solution->x);
}

/// The line through two neighbours and how well it matches.
struct Match {
  Moments moments;
  NormalLine line;
  double excess = std::numeric_limits<double>::infinity();  // of the worst point
};

Match match_of(const PointsView& points, const Piece& first, const Piece& second,
               const Tolerance& tolerance) {
  Match match;
  if (!second.joined || !first.line || !second.line) return match;
  // A cheap test first: at a corner the outer end of the shorter piece is far from the other wall.
  const bool first_is_longer = first.segment.size() >= second.segment.size();
  const NormalLine& longer = first_is_longer ? *first.line : *second.line;
  const std::size_t outer = first_is_longer ? second.segment.end - 1 : first.segment.begin;
  if (is_beyond(longer, points, outer, tolerance)) return match;

  match.moments = first.moments;
  match.moments += second.moments;
  const auto line = line_of(match.moments);
  if (!line) return match;
  match.line = *line;
  const PointsView both = points.subview(first.segment.begin, second.segment.end);
  const FarthestPoint farthest = farthest_from(match.line, both, tolerance);
  if (!farthest.beyond()) match.excess = farthest.excess;
  return match;
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

void fit_pieces(const PointsView& points, std::vector<Piece>& pieces) {
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    if (pieces[i].round || pieces[i].line) continue;
    const bool at_seam = i == 0 || i + 1 == pieces.size();
    if (!at_seam && !pieces[i].joined && !pieces[i + 1].joined) continue;
    pieces[i].moments = inner_moments(points, pieces[i].segment);
    pieces[i].line = line_of(pieces[i].moments);
  }
}

namespace {

/// The matches of all neighbours, the best first. Each is found once, so that many pieces take
/// little more than one by one.
class Matches {
 public:
  Matches(const PointsView& points, const Tolerance& tolerance, std::vector<Piece>& pieces)
      : points_(points),
        tolerance_(tolerance),
        pieces_(pieces),
        found_(pieces.size()),
        points_left_(most_points_looked_at * points.size()) {
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      found_[i].before = i - 1;
      found_[i].next = i + 1;
    }
    for (std::size_t i = 1; i < pieces.size(); ++i) look_at(i);
  }

  /// Joins the two that match best; false when no two do.
  bool join_best() {
    while (!waiting_.empty() && !is_valid(waiting_.top())) waiting_.pop();
    if (waiting_.empty()) return false;
    join(waiting_.top().second);
    return true;
  }

  /// Only what is left.
  void compact() {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < pieces_.size(); i = found_[i].next) pieces_[kept++] = pieces_[i];
    pieces_.resize(kept);
  }

 private:
  // Of a piece with the one before it.
  struct Found {
    std::size_t before = 0;  // number of the neighbours
    std::size_t next = 0;
    std::size_t looks = 0;
    Match match;
  };
  struct Waiting {
    double excess = 0.0;
    std::size_t second = 0;
    std::size_t look = 0;
    // The best on top; of equal ones the first of the scan.
    friend bool operator<(const Waiting& a, const Waiting& b) {
      return std::pair(a.excess, a.second) > std::pair(b.excess, b.second);
    }
  };

  [[nodiscard]] bool is_valid(const Waiting& waiting) const {
    return found_[waiting.second].looks == waiting.look;
  }

  void look_at(std::size_t second) {
    Found& found = found_[second];
    ++found.looks;
    const Segment both{pieces_[found.before].segment.begin, pieces_[second].segment.end};
    if (both.size() > points_left_) return;
    points_left_ -= both.size();
    found.match = match_of(points_, pieces_[found.before], pieces_[second], tolerance_);
    if (!std::isinf(found.match.excess)) {
      waiting_.push({found.match.excess, second, found.looks});
    }
  }

  void join(std::size_t second) {
    const Found& found = found_[second];
    const std::size_t first = found.before;
    pieces_[first].segment.end = pieces_[second].segment.end;
    pieces_[first].moments = found.match.moments;
    pieces_[first].line = found.match.line;
    ++found_[second].looks;  // what waits of it is of no use any more
    found_[first].next = found.next;
    if (found.next < pieces_.size()) {
      found_[found.next].before = first;
      look_at(found.next);
    }
    if (first > 0) look_at(first);
  }

  // Of all points: even where a wall is joined from its many parts one by one, which the walls of
  // rooms never are, the work stays bounded. What is not looked at stays as it is.
  static constexpr std::size_t most_points_looked_at = 500;

  const PointsView& points_;
  const Tolerance& tolerance_;
  std::vector<Piece>& pieces_;
  std::vector<Found> found_;
  std::priority_queue<Waiting> waiting_;
  std::size_t points_left_;
};

}  // namespace

void merge_collinear(const PointsView& points, const Tolerance& tolerance,
                     std::vector<Piece>& pieces) {
  if (pieces.size() < 2) return;
  Matches matches(points, tolerance, pieces);
  bool any = false;
  while (matches.join_best()) any = true;
  if (any) matches.compact();
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
