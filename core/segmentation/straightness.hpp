// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "core/segmentation/block_test.hpp"
#include "core/segmentation/pieces.hpp"
#include "core/segmentation/segment.hpp"
#include "core/segmentation/tolerance.hpp"
#include "core/sensor/points.hpp"

namespace quoin {

/// Makes pieces true lines: what a method takes for one wall within `split_distance` may contain
/// points of something else, or be two walls. Keeps its memory.
class Straightener {
 public:
  explicit Straightener(const SegmentationParameters& parameters);

  /// Splits pieces whose points refute that they are one wall, leaves out points at their ends,
  /// gives them the free points beside them that are on their walls, and joins walls that go on
  /// behind something. Adds to `foreign` the points inside pieces that are not of their walls, in
  /// no order; after `many_strays` of a scan also those that are doubtful. `find_arcs` has been
  /// there before. Returns whether it changed anything; the pieces that it changed have no line.
  bool run(const PointsView& points, const SensorModel& sensor,
           std::span<const TestedBlocks> blocks, bool many_strays, std::vector<Piece>& pieces,
           std::vector<std::size_t>& foreign);

 private:
  /// A piece with the moments that show whether it is one line with another.
  struct Wall {
    Piece piece;
    Moments moments;
    NormalLine line;
  };

  /// The wall before as many others that a wall is one with.
  struct Partner {
    std::size_t passed;
    NormalLine line;  // of both
  };

  void add(const Piece& piece, const Moments& moments, const NormalLine& line);
  void split(const PointsView& points, const Piece& piece);
  [[nodiscard]] bool trim(const PointsView& points, const Segment& range);
  [[nodiscard]] std::size_t best_split(const PointsView& points, const Segment& range);
  [[nodiscard]] bool is_part(const PointsView& points, const Wall& wall,
                             const NormalLine& line) const;
  [[nodiscard]] std::optional<Partner> find_partner(const PointsView& points, const Wall& wall);
  [[nodiscard]] std::optional<NormalLine> join(const PointsView& points, const Wall& first,
                                               const Wall& second,
                                               std::vector<std::size_t>& foreign) const;

  [[nodiscard]] bool grow(const PointsView& points);
  void leave_out_doubtful(const PointsView& points);

  SegmentationParameters parameters_;  // with the flatness for the distance
  std::size_t fewest_;
  SensorModel sensor_;
  Tolerance tolerance_;
  std::vector<Wall> walls_, joined_;
  std::vector<Segment> stack_;  // still to be examined, the leftmost on top
  std::vector<std::size_t> kept_, next_, outside_;
  std::vector<Moments> sums_;
};

}  // namespace quoin
