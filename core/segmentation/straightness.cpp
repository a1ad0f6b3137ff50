// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/segmentation/straightness.hpp"

#include <algorithm>
#include <cmath>

#include "core/fitting/orthogonal.hpp"
#include "core/segmentation/runs.hpp"

namespace quoin {
namespace {

constexpr int most_trims = 8;
// Of the points of a piece: a wall is most of what a method took for one.
constexpr double fewest_kept = 0.75;
// A likelihood ratio for two lines instead of one, with a place to split that was searched for.
constexpr double significant_rise = 25.0;
constexpr std::size_t fewest_on_a_side = 3;
constexpr std::size_t places_to_look = 32;
// Pieces between two parts of a wall, which strays have made of its points.
constexpr std::size_t most_passed = 3;
// Tolerances that a short wall on a long one's line may end beside it.
constexpr double far_off = 4.0;
// Of a tolerance: three standard deviations.
constexpr double doubtful = 0.75;
// Two lines of one wall exceed it once in 1000 times.
constexpr double same_line = 13.816;

SegmentationParameters with_flatness(SegmentationParameters parameters) {
  parameters.split_distance = parameters.flatness;
  return parameters;
}

/// Sum of the squared distances of points from their line; their moments are about one of them.
double squared_distances(const Moments& sums) {
  return orthogonal_line(CentralMoments(sums)).across;
}

}  // namespace

Straightener::Straightener(const SegmentationParameters& parameters)
    : parameters_(with_flatness(parameters)),
      fewest_(std::max(static_cast<std::size_t>(parameters.min_points), fewest_points + 1)) {}

void Straightener::add(const Piece& piece, const Moments& moments, const NormalLine& line) {
  walls_.push_back({piece, moments, line});
}

/// Fills `kept_` with the points of the range that are on its wall: within the tolerance of the
/// line of just those points. False when there is no such wall, or another one beside it.
bool Straightener::trim(const PointsView& points, const Segment& range) {
  kept_.clear();
  for (std::size_t i = range.begin; i < range.end; ++i) kept_.push_back(i);
  const auto enough = fewest_kept * static_cast<double>(range.size());
  for (int k = 0; k < most_trims; ++k) {
    Moments moments;
    for (const std::size_t i : kept_) moments.add(points.x[i], points.y[i]);
    const OrthogonalLine fit = orthogonal_line(moments);
    if (!fit.ok()) return false;
    next_.clear();
    for (std::size_t i = range.begin; i < range.end; ++i) {
      if (!is_beyond(fit.line, points, i, tolerance_)) next_.push_back(i);
    }
    if (next_.size() < fewest_ || static_cast<double>(next_.size()) < enough) return false;
    if (next_ == kept_) break;
    std::swap(kept_, next_);
  }
  // So many points in a row are a surface of their own.
  std::size_t free_from = range.begin;
  for (const std::size_t i : kept_) {
    if (i - free_from >= fewest_) return false;
    free_from = i + 1;
  }
  return range.end - free_from < fewest_;
}

/// Where two lines fit the points of the range so much better than one that it is no chance; 0 when
/// nowhere.
std::size_t Straightener::best_split(const PointsView& points, const Segment& range) {
  const double x = points.x[range.begin];
  const double y = points.y[range.begin];
  sums_.resize(range.size() + 1);
  sums_[0] = {};
  for (std::size_t k = 0; k < range.size(); ++k) {
    sums_[k + 1] = sums_[k];
    sums_[k + 1].add(points.x[range.begin + k] - x, points.y[range.begin + k] - y);
  }
  const OrthogonalLine whole = orthogonal_line(CentralMoments(sums_.back(), x, y));
  if (!whole.ok() || range.size() < 2 * fewest_on_a_side) return 0;
  const double middle = std::hypot(whole.moments.mean_x, whole.moments.mean_y);
  const double variance =
      tolerance_.squared(whole.line.offset / middle, whole.line.offset, whole.tangential_mean()) /
      (deviations_in_tolerance * deviations_in_tolerance);
  double largest = significant_rise * variance;
  std::size_t best = 0;
  const auto look = [&](std::size_t k) {
    Moments rest = sums_.back();
    rest -= sums_[k];
    const double rise = whole.across - squared_distances(sums_[k]) - squared_distances(rest);
    if (!(rise > largest)) return;
    largest = rise;
    best = k;
  };
  const std::size_t last = range.size() - fewest_on_a_side;
  const std::size_t step = 1 + range.size() / places_to_look;
  for (std::size_t k = fewest_on_a_side; k <= last; k += step) look(k);
  if (best == 0) return 0;
  const std::size_t coarse = best;
  const std::size_t first = std::max(coarse - std::min(coarse, step - 1), fewest_on_a_side);
  for (std::size_t k = first; k <= std::min(coarse + step - 1, last); ++k) look(k);
  return range.begin + best;
}

void Straightener::split(const PointsView& points, const Piece& piece) {
  bool joined = piece.joined;
  stack_.clear();
  stack_.push_back(piece.segment);
  const auto accept = [&](const Segment& segment, const BlockMeans& blocks,
                          const NormalLine& line) {
    add({.segment = segment, .joined = joined}, blocks.moments(), line);
    joined = true;
  };
  while (!stack_.empty()) {
    const Segment range = stack_.back();
    stack_.pop_back();
    if (range.size() < fewest_) continue;
    if (trim(points, range)) {
      const BlockMeans blocks(points, kept_);
      const BlockTest test = test_blocks(blocks, sensor_, parameters_.flatness);
      if (!test.crooked) {
        const Segment run{kept_.front(), kept_.back() + 1};
        accept(run, blocks, test.line);
        std::size_t next = 0;
        for (std::size_t i = run.begin; i < run.end; ++i) {
          if (kept_[next] == i) {
            ++next;
          } else {
            outside_.push_back(i);
          }
        }
        continue;
      }
    }
    const std::size_t vertex = best_split(points, range);
    if (vertex == 0) {
      // A long wall may be uneven; what is short and crooked is none.
      if (squared_distance(points, range.begin, range.end - 1) < short_wall * short_wall) continue;
      const BlockMeans blocks(points, range);
      accept(range, blocks, test_blocks(blocks, sensor_, parameters_.flatness).line);
      continue;
    }
    stack_.push_back({vertex, range.end});
    stack_.push_back({range.begin, vertex});
  }
}

/// Whether it is no wall of its own beside the wall of this line: too short for one, a leg or a few
/// points by chance, or mostly points of that wall.
bool Straightener::is_part(const PointsView& points, const Wall& wall,
                           const NormalLine& line) const {
  const Segment& own = wall.piece.segment;
  const double enough = 0.5 * parameters_.min_length;
  if (squared_distance(points, own.begin, own.end - 1) < enough * enough) return true;
  if (wall.piece.round) return false;
  std::size_t beyond = 0;
  for (std::size_t i = own.begin; i < own.end; ++i) {
    beyond += is_beyond(line, points, i, tolerance_) ? 1 : 0;
  }
  return 2 * beyond < own.size();
}

/// Nothing when none of the last walls is one with this one.
std::optional<Straightener::Partner> Straightener::find_partner(const PointsView& points,
                                                                const Wall& wall) {
  const std::size_t most = std::min(joined_.size(), most_passed + 1);
  for (std::size_t passed = most; passed-- > 0;) {
    const std::span<const Wall> last = std::span<const Wall>(joined_).last(passed + 1);
    const Wall& partner = last.front();
    const std::size_t known = outside_.size();
    const auto line = join(points, partner, wall, outside_);
    if (!line) continue;
    const std::span<const Wall> between = last.subspan(1);
    if (std::all_of(between.begin(), between.end(),
                    [&](const Wall& each) { return is_part(points, each, *line); })) {
      return Partner{passed, *line};
    }
    outside_.resize(known);
  }
  return std::nullopt;
}

/// The line of both when they are one wall; what is between them and not on it is added to
/// `foreign`.
std::optional<NormalLine> Straightener::join(const PointsView& points, const Wall& first,
                                             const Wall& second,
                                             std::vector<std::size_t>& foreign) const {
  if (first.piece.round || second.piece.round) return std::nullopt;
  const Segment& a = first.piece.segment;
  const Segment& b = second.piece.segment;
  if (squared_distance(points, a.end - 1, b.begin) >
      parameters_.max_line_gap * parameters_.max_line_gap) {
    return std::nullopt;
  }
  // A cheap test first: at a corner the outer end of the shorter one is far from the other wall.
  const bool first_is_longer = first.moments.weight > second.moments.weight;
  const NormalLine& longer = first_is_longer ? first.line : second.line;
  const std::size_t outer = first_is_longer ? b.end - 1 : a.begin;
  const double off = longer.distance(points.x[outer], points.y[outer]);
  if (off * off > far_off * far_off * tolerance_.largest) return std::nullopt;
  const auto difference = squared_mahalanobis(first.moments, second.moments, tolerance_);
  if (!difference || *difference > same_line) return std::nullopt;
  Moments both = first.moments;
  both += second.moments;
  const NormalLine line = orthogonal_line(both).line;
  for (const std::size_t end : {a.begin, a.end - 1, b.begin, b.end - 1}) {
    if (is_beyond(line, points, end, tolerance_)) return std::nullopt;
  }
  // What is seen behind the line is seen through an opening.
  const std::size_t known = foreign.size();
  std::size_t behind = 0;
  for (std::size_t i = a.end; i < b.begin; ++i) {
    if (!is_beyond(line, points, i, tolerance_)) continue;
    foreign.push_back(i);
    if (line.distance(points.x[i], points.y[i]) * line.offset > 0.0) ++behind;
  }
  if (2 * behind > b.begin - a.end) {
    foreign.resize(known);
    return std::nullopt;
  }
  return line;
}

/// What stood in front of a wall near its end has cut off a few points there.
bool Straightener::grow(const PointsView& points) {
  bool grown = false;
  const double gap = parameters_.max_line_gap * parameters_.max_line_gap;
  // The last of the `free` points from `last` on that is on the wall; index k counts away from it.
  const auto reach = [&](const NormalLine& line, std::size_t last, std::size_t free, auto index) {
    std::size_t reached = 0;
    for (std::size_t k = 1; k <= free && k - reached <= fewest_; ++k) {
      if (is_beyond(line, points, index(k), tolerance_)) continue;
      if (squared_distance(points, reached > 0 ? index(reached) : last, index(k)) > gap) break;
      for (std::size_t off = reached + 1; off < k; ++off) outside_.push_back(index(off));
      reached = k;
    }
    grown = grown || reached > 0;
    return reached;
  };
  for (std::size_t w = 0; w < walls_.size(); ++w) {
    if (walls_[w].piece.round) continue;
    Segment& own = walls_[w].piece.segment;
    const std::size_t begin = w > 0 ? walls_[w - 1].piece.segment.end : 0;
    const std::size_t end =
        w + 1 < walls_.size() ? walls_[w + 1].piece.segment.begin : points.size();
    const NormalLine& line = walls_[w].line;
    const std::size_t first = own.begin;
    const std::size_t last = own.end - 1;
    const std::size_t size = own.size();
    own.end += reach(line, last, end - own.end, [last](std::size_t k) { return last + k; });
    own.begin -=
        reach(line, first, own.begin - begin, [first](std::size_t k) { return first - k; });
    if (own.size() > size) walls_[w].piece.line.reset();
  }
  return grown;
}

/// Where many rays return from before the walls, some do so from just before them.
void Straightener::leave_out_doubtful(const PointsView& points) {
  SegmentationParameters narrow = parameters_;
  narrow.noise_factor *= doubtful;
  const Tolerance tolerance(narrow, sensor_, points);
  for (Wall& wall : joined_) {
    if (wall.piece.round) continue;
    const auto is_doubtful = [&](std::size_t i) {
      return is_beyond(wall.line, points, i, tolerance);
    };
    Segment& own = wall.piece.segment;
    while (own.size() > fewest_ && is_doubtful(own.begin)) ++own.begin;
    while (own.size() > fewest_ && is_doubtful(own.end - 1)) --own.end;
    for (std::size_t i = own.begin; i < own.end; ++i) {
      if (is_doubtful(i)) outside_.push_back(i);
    }
    wall.piece.line.reset();
  }
}

bool Straightener::run(const PointsView& points, const SensorModel& sensor,
                       std::span<const TestedBlocks> blocks, bool many_strays,
                       std::vector<Piece>& pieces, std::vector<std::size_t>& foreign) {
  sensor_ = sensor;
  tolerance_ = Tolerance(parameters_, sensor, points);
  walls_.clear();
  outside_.clear();
  bool changed = false;
  for (std::size_t k = 0; k < pieces.size(); ++k) {
    const Piece& piece = pieces[k];
    if (piece.round) {
      add(piece, {}, {});
      continue;
    }
    const BlockTest& test = blocks[k].test;
    const PointsView own = points.subview(piece.segment.begin, piece.segment.end);
    if (test.crooked || farthest_from(test.line, own, tolerance_).beyond()) {
      split(points, piece);
      changed = true;
    } else {
      add(piece, blocks[k].means.moments(), test.line);
    }
  }

  changed = grow(points) || changed;

  joined_.clear();
  for (const Wall& wall : walls_) {
    const auto partner = find_partner(points, wall);
    if (!partner) {
      joined_.push_back(wall);
      continue;
    }
    joined_.resize(joined_.size() - partner->passed);
    Wall& last = joined_.back();
    last.piece.segment.end = wall.piece.segment.end;
    last.piece.line.reset();
    last.moments += wall.moments;
    last.line = partner->line;
    changed = true;
  }
  if (many_strays) {
    leave_out_doubtful(points);
    changed = true;
  }
  pieces.clear();
  for (const Wall& wall : joined_) pieces.push_back(wall.piece);
  foreign.insert(foreign.end(), outside_.begin(), outside_.end());
  return changed;
}

}  // namespace quoin
