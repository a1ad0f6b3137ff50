// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/segmentation/collinear_merge.hpp"

#include <algorithm>
#include <cmath>

namespace quoin {
namespace {

// Of all points: even where a wall is joined from its many parts one by one, which the walls of
// rooms never are, the work stays bounded. What is not looked at stays as it is.
constexpr std::size_t most_points_looked_at = 500;

}  // namespace

CollinearMerge::Match CollinearMerge::match_of(const PointsView& points, const Piece& first,
                                               const Piece& second, const Tolerance& tolerance) {
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

void CollinearMerge::look_at(std::size_t second, const PointsView& points,
                             const Tolerance& tolerance, const std::vector<Piece>& pieces) {
  Neighbour& found = neighbours_[second];
  ++found.looks;
  const Segment both{pieces[found.before].segment.begin, pieces[second].segment.end};
  if (both.size() > points_left_) {
    all_ = false;
    return;
  }
  points_left_ -= both.size();
  found.match = match_of(points, pieces[found.before], pieces[second], tolerance);
  if (std::isinf(found.match.excess)) return;
  waiting_.push_back({found.match.excess, second, found.looks});
  std::push_heap(waiting_.begin(), waiting_.end());
}

std::size_t CollinearMerge::take_best() {
  while (!waiting_.empty()) {
    const Waiting best = waiting_.front();
    std::pop_heap(waiting_.begin(), waiting_.end());
    waiting_.pop_back();
    if (neighbours_[best.second].looks == best.look) return best.second;
  }
  return 0;
}

bool CollinearMerge::operator()(const PointsView& points, const Tolerance& tolerance,
                                std::vector<Piece>& pieces) {
  all_ = true;
  if (pieces.size() < 2) return all_;
  neighbours_.assign(pieces.size(), {});
  waiting_.clear();
  points_left_ = most_points_looked_at * points.size();
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    neighbours_[i].before = i - 1;
    neighbours_[i].next = i + 1;
  }
  for (std::size_t i = 1; i < pieces.size(); ++i) look_at(i, points, tolerance, pieces);

  bool any = false;
  while (const std::size_t second = take_best()) {
    any = true;
    Neighbour& found = neighbours_[second];
    const std::size_t first = found.before;
    pieces[first].segment.end = pieces[second].segment.end;
    pieces[first].moments = found.match.moments;
    pieces[first].line = found.match.line;
    ++found.looks;  // what waits of it is of no use any more
    neighbours_[first].next = found.next;
    if (found.next < pieces.size()) {
      neighbours_[found.next].before = first;
      look_at(found.next, points, tolerance, pieces);
    }
    if (first > 0) look_at(first, points, tolerance, pieces);
  }
  if (!any) return all_;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < pieces.size(); i = neighbours_[i].next) pieces[kept++] = pieces[i];
  pieces.resize(kept);
  return all_;
}

}  // namespace quoin
