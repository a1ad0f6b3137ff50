// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <bit>
#include <cstddef>
#include <span>
#include <vector>

#include "core/segmentation/arcs.hpp"
#include "core/segmentation/breakpoints.hpp"
#include "core/segmentation/collinear_merge.hpp"
#include "core/segmentation/pieces.hpp"
#include "core/segmentation/segment.hpp"
#include "core/segmentation/straightness.hpp"
#include "core/segmentation/tolerance.hpp"
#include "core/segmentation/trace.hpp"

namespace quoin {

/// Splits of a contour may be as uneven as they like while they are not deep, as those of rooms
/// are; below this depth a piece is to be split in its middle, so that n points take n log n steps
/// whatever is scanned.
[[nodiscard]] inline std::size_t deepest_uneven_split(std::size_t points) {
  return 8 * static_cast<std::size_t>(std::bit_width(points));
}

/// What all segmenters share: clusters between break points before the method's own work; merging,
/// boundaries and selection after it. Keeps its memory from scan to scan.
class SegmentBuilder {
 public:
  explicit SegmentBuilder(const SegmentationParameters& parameters);

  /// Finds the clusters of a new scan and clears the pieces of the last. Returns the points that
  /// the method works on: those of the scan, but for strays and what stands for no return. The scan
  /// has to stay until `finish`.
  [[nodiscard]] PointsView start(const PointsView& scan, const SensorModel& sensor);

  /// Runs of points without a break of the surface, ascending; together they are all of them.
  [[nodiscard]] std::span<const Segment> clusters() const { return clusters_; }

  /// The points that the method works on.
  [[nodiscard]] const CoarsePoints& coarse_points() const { return coarse_points_; }

  /// Of these points; of the noise that the scan shows when that is more than its sensor's.
  [[nodiscard]] const Tolerance& tolerance() const { return tolerance_; }

  /// The next straight piece that the method has found: behind the one before, and inside one
  /// cluster. Points between pieces belong to none.
  void add(const Segment& piece);

  /// The pieces of one cluster, found in any order; sorts them.
  void add_all(std::vector<Segment>& pieces);

  /// Notes that the method has left some of its work, to be done with the scan in time.
  void cut_short() { cut_short_ = true; }

  /// Merges, straightens, refines and selects as the parameters say. The result is of the points of
  /// the scan.
  void finish(Segmentation& found);

 private:
  void leave_out(std::span<const std::size_t> left_out);
  void begin_trace(SegmentationTrace& trace) const;
  /// Points that were in pieces at the last call and are no more: that step took them.
  void note_lost(PointOutcome step, SegmentationTrace* trace);
  void end_trace(const Segmentation& found, const std::vector<PointOutcome>& verdicts,
                 SegmentationTrace& trace) const;
  /// The indices of own points become those of the scan; those in between are foreign.
  void to_scan(Segmentation& found) const;

  SegmentationParameters parameters_;
  BreakpointDetector breakpoints_;
  CollinearMerge merge_;
  Straightener straightener_;
  ThinThings thin_things_;
  PointsView scan_;
  PointsView points_;
  Points own_;                        // those of the scan without `removed_`, when there are any
  std::vector<std::size_t> removed_;  // in the scan, ascending
  std::vector<std::size_t> left_out_;
  CoarsePoints coarse_points_;
  SensorModel sensor_;
  Tolerance tolerance_;
  std::vector<Segment> clusters_;
  std::vector<Piece> pieces_;
  std::vector<TestedBlocks> blocks_;  // of the pieces
  bool many_strays_ = false;
  std::size_t no_return_ = 0;
  bool cut_short_ = false;
  std::vector<char> covered_;  // by point of the scan: in a piece; only when traced
  bool closed_ = false;        // the surface goes on from the last point to the first
  std::size_t cluster_ = 0;    // of the last piece
};

}  // namespace quoin
