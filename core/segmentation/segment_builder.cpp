// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/segmentation/segment_builder.hpp"

#include <algorithm>
#include <cmath>

#include "core/sensor/multiversion.hpp"

namespace quoin {
namespace {

constexpr double significance = 2.0;  // standard deviations of the sagitta

struct Mean {
  double x, y;  // [m]
};

/// Means of the first and last quarters and of the half between them.
struct Means {
  Mean first, inner, last;
};

[[gnu::always_inline]] inline Mean mean_of(const double* __restrict x, const double* __restrict y,
                                           std::size_t begin, std::size_t end) {
  Mean sum{0.0, 0.0};
  for (std::size_t i = begin; i < end; ++i) {
    sum.x += x[i];
    sum.y += y[i];
  }
  const auto scale = 1.0 / static_cast<double>(end - begin);
  return {sum.x * scale, sum.y * scale};
}

QUOIN_MULTIVERSION
void find_means(const double* __restrict x, const double* __restrict y, std::size_t count,
                Means& out) {
  const std::size_t quarter = count / 4;
  out.first = mean_of(x, y, 0, quarter);
  out.inner = mean_of(x, y, quarter, count - quarter);
  out.last = mean_of(x, y, count - quarter, count);
}

/// A bow of sagitta s over its chord has its inner half by s / 2 beside its two outer quarters, and
/// the difference of those means has the variance 4 / n of a point's.
bool is_bent(const PointsView& points, const Segment& segment, const NormalLine& chord,
             double length, const SensorModel& sensor, double max_bend) {
  Means means;
  find_means(&points.x[segment.begin], &points.y[segment.begin], segment.size(), means);
  const double dx = means.inner.x - 0.5 * (means.first.x + means.last.x);
  const double dy = means.inner.y - 0.5 * (means.first.y + means.last.y);
  const double sagitta = 2.0 * std::abs(chord.normal_x * dx + chord.normal_y * dy);
  if (!(sagitta > max_bend * length)) return false;

  const std::size_t middle = segment.begin + segment.size() / 2;
  const double cos_phi =
      points.cosine[middle] * chord.normal_x + points.sine[middle] * chord.normal_y;
  const double sin_phi =
      points.sine[middle] * chord.normal_x - points.cosine[middle] * chord.normal_y;
  const double across = sensor.range_stddev * cos_phi;
  const double along = sensor.bearing_stddev * points.range[middle] * sin_phi;
  const double variance =
      16.0 * (across * across + along * along) / static_cast<double>(segment.size());
  return sagitta * sagitta > significance * significance * variance;
}

/// Squared length [m^2] of a piece that is straight and longer than its tolerance is wide; else 0.
double straight_length_squared(const PointsView& points, const Segment& segment,
                               const SensorModel& sensor, const Tolerance& tolerance,
                               double max_bend) {
  const double dx = points.x[segment.end - 1] - points.x[segment.begin];
  const double dy = points.y[segment.end - 1] - points.y[segment.begin];
  const double squared = dx * dx + dy * dy;
  if (!(squared > 4.0 * tolerance.base)) return 0.0;
  // Longer than ten times the tolerance, with the default bend: no table leg, bin or person.
  if (4.0 * max_bend * max_bend * squared > tolerance.largest) return squared;
  const double length = std::sqrt(squared);
  const NormalLine chord{-dy / length, dx / length, 0.0};
  const std::size_t middle = segment.begin + segment.size() / 2;
  const double width_squared =
      4.0 * tolerance.squared(points, middle, chord.normal_x, chord.normal_y);
  if (!(squared > width_squared)) return 0.0;
  return segment.size() >= 4 && is_bent(points, segment, chord, length, sensor, max_bend) ? 0.0
                                                                                          : squared;
}

/// Appends to `segments` the pieces that are usable lines:
/// - of `min_points` points and `min_length`; half of that beside a joined piece that is long
///   enough, because small pieces with nothing beside them are mostly of clutter,
/// - longer than the band of their tolerance is wide: noise makes short ones out of nothing,
/// - not bent: table legs, bins and people are round, and pieces of them fit into the tolerance.
///   Bent is what has a sagitta of more than `max_bend` of its length that noise does not explain.
void select_lines(const PointsView& points, const std::vector<Piece>& pieces,
                  const SegmentationParameters& parameters, const SensorModel& sensor,
                  const Tolerance& tolerance, std::vector<Segment>& segments) {
  const auto min_points = static_cast<std::size_t>(parameters.min_points);
  const double enough = parameters.min_length * parameters.min_length;
  double before = 0.0;   // squared length of the piece before
  bool pending = false;  // it is short and waits for a long one beside it
  Segment last;
  for (const Piece& piece : pieces) {
    const bool counts = piece.segment.size() >= min_points;
    const double length = counts ? straight_length_squared(points, piece.segment, sensor, tolerance,
                                                           parameters.max_bend)
                                 : 0.0;
    const bool is_long = length > 0.0 && length >= enough;
    const bool is_half = length > 0.0 && 4.0 * length >= enough;
    if (pending && piece.joined && is_long) segments.push_back(last);
    const bool supported = piece.joined && before > 0.0 && before >= enough;
    if (is_long || (is_half && supported)) segments.push_back(piece.segment);
    pending = is_half && !is_long && !supported;
    last = piece.segment;
    before = length;
  }
}

}  // namespace

SegmentBuilder::SegmentBuilder(const SegmentationParameters& parameters)
    : parameters_(parameters), breakpoints_(parameters.breakpoint_angle) {}

void SegmentBuilder::start(const PointsView& points, const SensorModel& sensor) {
  pieces_.clear();
  cluster_ = 0;
  sensor_ = sensor;
  tolerance_ = Tolerance(parameters_, sensor, points);
  coarse_points_.assign(points);
  closed_ = !breakpoints_.find(coarse_points_, sensor, clusters_);
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
  std::sort(pieces.begin(), pieces.end(),
            [](const Segment& a, const Segment& b) { return a.begin < b.begin; });
  for (const Segment& piece : pieces) add(piece);
}

void SegmentBuilder::finish(const PointsView& points, std::vector<Segment>& segments) {
  segments.clear();
  const auto min_points = static_cast<std::size_t>(parameters_.min_points);
  if (parameters_.merge || parameters_.refine) {
    drop_small(min_points, pieces_);
    fit_pieces(points, pieces_);
  }
  if (parameters_.merge) merge_collinear(points, tolerance_, pieces_);
  if (parameters_.refine) refine_boundaries(points, min_points, tolerance_, closed_, pieces_);

  select_lines(points, pieces_, parameters_, sensor_, tolerance_, segments);
}

}  // namespace quoin
