// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/segmentation/split_and_merge.hpp"

namespace quoin {
namespace {

// A piece ends at least so many points before a vertex: the line of two points touches both.
constexpr std::size_t fewest_to_split = 2;

/// The point farthest from the line, not one of the outermost, on the side where `sign` is that of
/// the distance.
std::size_t farthest_on_side(const PointsView& points, const Segment& piece, const NormalLine& line,
                             double sign) {
  std::size_t farthest = piece.begin;
  double largest = 0.0;
  for (std::size_t i = piece.begin + fewest_to_split; i + fewest_to_split < piece.end; ++i) {
    const double distance = sign * line.distance(points.x[i], points.y[i]);
    if (distance > largest) {
      largest = distance;
      farthest = i;
    }
  }
  return farthest;
}

}  // namespace

SplitAndMerge::SplitAndMerge(const Parameters& parameters) : builder_(parameters) {}

std::size_t SplitAndMerge::vertex_of(const PointsView& points, const Segment& piece) const {
  if (piece.size() < 2 * fewest_to_split + 1) return piece.begin;
  const OrthogonalLine fit = orthogonal_line(moments_(piece.begin, piece.end));
  if (!fit.ok()) return piece.begin;
  const FarthestPoint farthest =
      farthest_from(fit.line, points.subview(piece.begin, piece.end), builder_.tolerance());
  if (!farthest.beyond()) return piece.begin;
  if (farthest.index >= fewest_to_split && farthest.index + fewest_to_split < piece.size()) {
    return piece.begin + farthest.index;
  }
  // The line through two walls is as far from their outer ends as from their corner, which is on
  // its other side.
  const std::size_t end = piece.begin + farthest.index;
  const double distance = fit.line.distance(points.x[end], points.y[end]);
  return farthest_on_side(points, piece, fit.line, distance > 0.0 ? -1.0 : 1.0);
}

void SplitAndMerge::split(const PointsView& points, const Segment& cluster) {
  // The leftmost is on top, so that pieces come out in order.
  const std::size_t deepest = deepest_uneven_split(cluster.size());
  stack_.clear();
  stack_.push_back({cluster});
  while (!stack_.empty()) {
    const auto [piece, depth] = stack_.back();
    const std::size_t vertex = vertex_of(points, piece);
    if (vertex != piece.begin) {
      const bool in_time = depth < deepest;
      if (!in_time) builder_.cut_short();
      const std::size_t cut = in_time ? vertex : piece.begin + piece.size() / 2;
      stack_.back() = {{cut, piece.end}, depth + 1};
      stack_.push_back({{piece.begin, cut}, depth + 1});
      continue;
    }
    stack_.pop_back();
    builder_.add(piece);
  }
}

void SplitAndMerge::operator()(const PointsView& scan, const SensorModel& sensor,
                               Segmentation& found) {
  const PointsView points = builder_.start(scan, sensor);
  moments_.assign(points);
  for (const Segment& cluster : builder_.clusters()) split(points, cluster);
  builder_.finish(found);
}

}  // namespace quoin
