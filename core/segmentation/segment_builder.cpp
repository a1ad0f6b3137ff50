// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/segmentation/segment_builder.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/segmentation/arcs.hpp"
#include "core/segmentation/strays.hpp"

namespace quoin {
namespace {

constexpr double significance = 2.0;  // standard deviations of the sagitta
// What a scan shows of its noise is itself an estimate.
constexpr double clearly_more = 1.5;
constexpr double many = 0.05;           // strays, of all points
constexpr double largest_noise = 0.06;  // [m] what scatters more is clutter

/// A bow of sagitta s over its chord has its inner half by s / 2 beside its two outer quarters, and
/// the difference of those means has the variance 4 / n of a point's.
bool is_bent(const PointsView& points, const Segment& segment, const NormalLine& chord,
             double length, const SensorModel& sensor, double max_bend) {
  const BlockMeans blocks(points, segment);
  const std::span<const BlockMean> means = blocks.means();
  const std::size_t quarter = means.size() / 4;
  double dx = 0.0;
  double dy = 0.0;
  for (std::size_t b = 0; b < means.size(); ++b) {
    const bool inner = b >= quarter && b < means.size() - quarter;
    dx += inner ? means[b].x : -means[b].x;
    dy += inner ? means[b].y : -means[b].y;
  }
  const double scale = 2.0 / static_cast<double>(means.size());
  const double sagitta = 2.0 * scale * std::abs(chord.normal_x * dx + chord.normal_y * dy);
  if (!(sagitta > max_bend * length)) return false;

  const std::size_t middle = segment.begin + segment.size() / 2;
  const double cos_phi =
      points.cosine[middle] * chord.normal_x + points.sine[middle] * chord.normal_y;
  const double sin_phi =
      points.sine[middle] * chord.normal_x - points.cosine[middle] * chord.normal_y;
  const double across = sensor.range_variance(points.range[middle]) * cos_phi * cos_phi;
  const double along = sensor.bearing_stddev * points.range[middle] * sin_phi;
  const double variance = 16.0 * (across + along * along) / static_cast<double>(segment.size());
  return sagitta * sagitta > significance * significance * variance;
}

/// Whether one point apart from the others decides over the direction: no two neighbours of a wall
/// are farther apart than half its length.
bool hangs_on_one_point(const PointsView& points, const Segment& segment, double squared_length) {
  const std::size_t last = segment.end - 1;
  return 4.0 * squared_distance(points, segment.begin, segment.begin + 1) > squared_length ||
         4.0 * squared_distance(points, last - 1, last) > squared_length;
}

/// Index among all points of the one at `i` among those that are left without `removed`, which are
/// ascending.
std::size_t index_with(std::span<const std::size_t> removed, std::size_t i) {
  std::size_t before = 0;
  std::size_t end = removed.size();
  while (before < end) {
    const std::size_t middle = before + (end - before) / 2;
    if (removed[middle] - middle <= i) {
      before = middle + 1;
    } else {
      end = middle;
    }
  }
  return i + before;
}

/// Squared length [m^2] of a piece that is straight and longer than its tolerance is wide; else 0,
/// and why.
struct StraightLength {
  double squared = 0.0;
  PointOutcome why = PointOutcome::too_short;
};

StraightLength straight_length(const PointsView& points, const Segment& segment,
                               const SensorModel& sensor, const Tolerance& tolerance,
                               double max_bend) {
  const double dx = points.x[segment.end - 1] - points.x[segment.begin];
  const double dy = points.y[segment.end - 1] - points.y[segment.begin];
  const double squared = dx * dx + dy * dy;
  if (!(squared > 4.0 * tolerance.base)) return {0.0, PointOutcome::too_narrow};
  if (segment.size() > 2 && hangs_on_one_point(points, segment, squared)) {
    return {0.0, PointOutcome::one_point};
  }
  // Longer than ten times the tolerance, with the default bend: no table leg, bin or person.
  if (4.0 * max_bend * max_bend * squared > tolerance.largest) return {squared};
  const double length = std::sqrt(squared);
  const NormalLine chord{-dy / length, dx / length, 0.0};
  const std::size_t middle = segment.begin + segment.size() / 2;
  const double width_squared =
      4.0 * tolerance.squared(points, middle, chord.normal_x, chord.normal_y);
  if (!(squared > width_squared)) return {0.0, PointOutcome::too_narrow};
  if (segment.size() >= 4 && is_bent(points, segment, chord, length, sensor, max_bend)) {
    return {0.0, PointOutcome::too_bent};
  }
  return {squared};
}

/// Without its first and its last point, where they are not left out at a corner already: a ray
/// that grazes an edge returns from between two surfaces, and one point of something too small for
/// a piece of its own is enough to turn a short line by more than its covariance says.
Segment without_ends(const Piece& piece, const SegmentationParameters& parameters) {
  Segment segment = piece.segment;
  const auto enough = static_cast<std::size_t>(parameters.min_points) + 2;
  if (!parameters.refine || segment.size() < enough) return segment;
  if (!piece.begins_at_corner) ++segment.begin;
  if (!piece.ends_at_corner) --segment.end;
  return segment;
}

/// Appends the round pieces to the arcs and to the segments those that are usable lines:
/// - of `min_points` points and `min_length`; half of that beside a joined piece that is long
///   enough, because small pieces with nothing beside them are mostly of clutter,
/// - longer than the band of their tolerance is wide: noise makes short ones out of nothing,
/// - with a direction that does not depend on one point at an end,
/// - not bent: table legs, bins and people are round, and pieces of them fit into the tolerance.
///   Bent is what has a sagitta of more than `max_bend` of its length that noise does not explain.
/// Where they are asked for, `verdicts` has one for each piece.
void select_lines(const PointsView& points, const std::vector<Piece>& pieces,
                  const SegmentationParameters& parameters, const SensorModel& sensor,
                  const Tolerance& tolerance, Segmentation& found,
                  std::vector<PointOutcome>* verdicts) {
  const auto min_points = static_cast<std::size_t>(parameters.min_points);
  const double enough = parameters.min_length * parameters.min_length;
  double before = 0.0;   // squared length of the piece before
  bool pending = false;  // it is short and waits for a long one beside it
  const Piece* last = nullptr;
  for (const Piece& piece : pieces) {
    if (piece.round) {
      if (verdicts != nullptr) verdicts->push_back(PointOutcome::arc);
      found.arcs.push_back(piece.segment);
      pending = false;
      before = 0.0;
      continue;
    }
    const bool counts = piece.segment.size() >= min_points;
    const StraightLength straight =
        counts ? straight_length(points, piece.segment, sensor, tolerance, parameters.max_bend)
               : StraightLength{0.0, PointOutcome::too_few_points};
    const double length = straight.squared;
    const bool is_long = length > 0.0 && length >= enough;
    const bool is_half = length > 0.0 && 4.0 * length >= enough;
    if (pending && piece.joined && is_long) {
      found.segments.push_back(without_ends(*last, parameters));
      if (verdicts != nullptr) verdicts->back() = PointOutcome::piece_end;
    }
    const bool supported = piece.joined && before > 0.0 && before >= enough;
    const bool usable = is_long || (is_half && supported);
    if (usable) found.segments.push_back(without_ends(piece, parameters));
    if (verdicts != nullptr) {
      verdicts->push_back(usable ? PointOutcome::piece_end : straight.why);
    }
    pending = is_half && !is_long && !supported;
    last = &piece;
    before = length;
  }
}

}  // namespace

SegmentBuilder::SegmentBuilder(const SegmentationParameters& parameters)
    : parameters_(parameters),
      breakpoints_(parameters.breakpoint_angle, parameters.max_line_gap),
      straightener_(parameters) {}

/// `left_out` holds indices of the points that are left, ascending.
void SegmentBuilder::leave_out(std::span<const std::size_t> left_out) {
  if (removed_.empty()) {
    own_.assign_without(left_out, points_);
    removed_.assign(left_out.begin(), left_out.end());
  } else {
    own_.erase(left_out);
    const std::size_t known = removed_.size();
    for (const std::size_t i : left_out) {
      const std::span<const std::size_t> before(removed_.data(), known);
      removed_.push_back(index_with(before, i));
    }
    std::sort(removed_.begin(), removed_.end());  // merging them would allocate
  }
  points_ = own_;
}

PointsView SegmentBuilder::start(const PointsView& scan, const SensorModel& sensor) {
  pieces_.clear();
  cluster_ = 0;
  scan_ = scan;
  points_ = scan;
  removed_.clear();
  cut_short_ = false;
  sensor_ = sensor;
  left_out_.clear();
  find_fill(points_, sensor_, left_out_);
  no_return_ = left_out_.size();
  if (!left_out_.empty()) leave_out(left_out_);

  const double noise = range_noise(points_);
  const double declared = declared_range_noise(points_, sensor_);
  if (noise > clearly_more * declared && noise <= largest_noise) {
    sensor_.range_stddev_per_metre *= declared > 0.0 ? noise / declared : 1.0;
    sensor_.range_stddev *= declared > 0.0 ? noise / declared : 1.0;
    if (!(declared > 0.0)) sensor_.range_stddev = noise;
  }
  coarse_points_.assign(points_);
  closed_ = !breakpoints_.find(coarse_points_, sensor_, clusters_);
  left_out_.clear();
  pass_over_strays(coarse_points_, breakpoints_,
                   static_cast<std::size_t>(parameters_.min_points) - 1, clusters_, left_out_);
  many_strays_ = static_cast<double>(left_out_.size()) > many * static_cast<double>(points_.size());
  if (!left_out_.empty()) {
    leave_out(left_out_);
    coarse_points_.erase(left_out_);
  }
  tolerance_ = Tolerance(parameters_, sensor_, points_);
  return points_;
}

void SegmentBuilder::add(const Segment& piece) {
  const std::size_t before = cluster_;
  while (clusters_[cluster_].end <= piece.begin) ++cluster_;
  const bool joined =
      !pieces_.empty() && before == cluster_ &&
      piece.begin - pieces_.back().segment.end < largest_gap(parameters_.min_points);
  pieces_.push_back({piece, joined});
}

void SegmentBuilder::add_all(std::vector<Segment>& pieces) {
  std::sort(pieces.begin(), pieces.end(), begins_before);
  for (const Segment& piece : pieces) add(piece);
}

void SegmentBuilder::finish(Segmentation& found) {
  found.clear();
  found.no_return = no_return_;
  SegmentationTrace* const trace = found.trace;
  if (trace != nullptr) begin_trace(*trace);
  note_lost(PointOutcome::no_line, trace);
  const auto min_points = static_cast<std::size_t>(parameters_.min_points);
  if (parameters_.merge || parameters_.refine) {
    // What a method cut off a wall is joined to it before it counts as small.
    drop_small(parameters_.merge ? fewest_points + 1 : min_points, min_points, pieces_);
    fit_pieces(points_, pieces_);
    note_lost(PointOutcome::too_few_points, trace);
  }
  if (parameters_.merge) {
    if (!merge_(points_, tolerance_, pieces_)) cut_short();
    drop_small(min_points, min_points, pieces_);
    note_lost(PointOutcome::too_few_points, trace);
    find_arcs(points_, sensor_, tolerance_, parameters_.flatness, pieces_, blocks_);
    left_out_.clear();
    const bool changed =
        straightener_.run(points_, sensor_, blocks_, many_strays_, pieces_, left_out_);
    if (!left_out_.empty()) {
      std::sort(left_out_.begin(), left_out_.end());
      left_out_.erase(std::unique(left_out_.begin(), left_out_.end()), left_out_.end());
      for (Piece& piece : pieces_) piece.segment = without(left_out_, piece.segment);
      leave_out(left_out_);
    }
    if (changed) fit_pieces(points_, pieces_);
    note_lost(PointOutcome::off_line, trace);
  }
  if (parameters_.refine) refine_boundaries(points_, min_points, tolerance_, closed_, pieces_);
  note_lost(PointOutcome::at_corner, trace);

  std::vector<PointOutcome> verdicts;  // no memory unless traced
  select_lines(points_, pieces_, parameters_, sensor_, tolerance_, found,
               trace != nullptr ? &verdicts : nullptr);
  found.cut_short = cut_short_;
  if (!removed_.empty()) to_scan(found);
  if (parameters_.merge) {
    thin_things_.find(scan_, sensor_, tolerance_, breakpoints_, parameters_.flatness, found);
  }
  if (trace != nullptr) end_trace(found, verdicts, *trace);
}

void SegmentBuilder::begin_trace(SegmentationTrace& trace) const {
  trace.outcomes.assign(scan_.size(), PointOutcome::no_line);
  for (const std::size_t i : removed_) trace.outcomes[i] = PointOutcome::foreign;
  std::vector<std::size_t> fill;
  find_fill(scan_, sensor_, fill);
  for (const std::size_t i : fill) trace.outcomes[i] = PointOutcome::no_return;
  trace.surfaces.assign(scan_.size(), 0);
  for (std::size_t k = 0; k < clusters_.size(); ++k) {
    const std::size_t end =
        k + 1 < clusters_.size() ? index_with(removed_, clusters_[k + 1].begin) : scan_.size();
    for (std::size_t i = index_with(removed_, clusters_[k].begin); i < end; ++i) {
      trace.surfaces[i] = static_cast<std::uint32_t>(k);
    }
  }
}

void SegmentBuilder::note_lost(PointOutcome step, SegmentationTrace* trace) {
  if (trace == nullptr) return;
  std::vector<char> now(scan_.size(), 0);
  for (const Piece& piece : pieces_) {
    for (std::size_t i = piece.segment.begin; i < piece.segment.end; ++i) {
      now[index_with(removed_, i)] = 1;
    }
  }
  if (step != PointOutcome::no_line) {  // the first call; what is in no piece is no_line already
    for (std::size_t i = 0; i < now.size(); ++i) {
      if (covered_[i] != 0 && now[i] == 0) trace->outcomes[i] = step;
    }
  }
  covered_ = std::move(now);
}

void SegmentBuilder::end_trace(const Segmentation& found, const std::vector<PointOutcome>& verdicts,
                               SegmentationTrace& trace) const {
  const auto set = [&](const Segment& run, PointOutcome outcome) {
    for (std::size_t i = run.begin; i < run.end; ++i) trace.outcomes[i] = outcome;
  };
  for (std::size_t k = 0; k < pieces_.size(); ++k) {
    const Segment& own = pieces_[k].segment;
    for (std::size_t i = own.begin; i < own.end; ++i) {
      trace.outcomes[index_with(removed_, i)] = verdicts[k];
    }
  }
  for (const Segment& run : found.segments) set(run, PointOutcome::segment);
  for (const Segment& run : found.arcs) set(run, PointOutcome::arc);
  // A foreign point of a thin thing in front of a wall is of an arc all the same.
  for (const std::size_t i : found.foreign) {
    const bool round = std::ranges::any_of(found.arcs, [&](const Segment& run) {
      return run.begin <= i && i < run.end && run.size() <= found.foreign.size();
    });
    if (!round) trace.outcomes[i] = PointOutcome::foreign;
  }
}

void SegmentBuilder::to_scan(Segmentation& found) const {
  for (std::vector<Segment>* runs : {&found.segments, &found.arcs}) {
    for (Segment& run : *runs) {
      run = {index_with(removed_, run.begin), index_with(removed_, run.end - 1) + 1};
      const auto first = std::lower_bound(removed_.begin(), removed_.end(), run.begin);
      const auto last = std::lower_bound(first, removed_.end(), run.end);
      found.foreign.insert(found.foreign.end(), first, last);
    }
  }
  std::sort(found.foreign.begin(), found.foreign.end());
}

}  // namespace quoin
