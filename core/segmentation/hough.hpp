// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <tuple>
#include <vector>

#include "core/segmentation/runs.hpp"
#include "core/segmentation/segment_builder.hpp"

namespace quoin {

/// The votes of points for the lines through them, by the direction of the normal and the distance
/// from the middle of the points: the smaller a cluster, the fewer cells, and the less the width of
/// a direction moves its ends.
class HoughVotes {
 public:
  /// Widths of a cell [rad] and [m]. The distance is divided more coarsely when the points are
  /// farther apart than most_offsets cells.
  HoughVotes(double angle_resolution, double offset_resolution);

  static constexpr std::size_t most_offsets = 2048;

  /// Clears all votes and adds those of these points.
  void start(const PointsView& points, const Segment& cluster);

  struct Peak {
    std::int32_t votes = 0;
    NormalLine line;  ///< of the middle of the cell
    std::size_t cell = 0;
  };
  /// The cell with most votes.
  [[nodiscard]] Peak peak() const;

  /// Excludes the cell from the peaks.
  void discard(std::size_t cell);

  /// Subtracts the votes of these points, each at most once.
  void take_back(const PointsView& points, const Segment& run);

 private:
  void vote(double x, double y, std::int32_t change);

  double offset_resolution_;
  std::vector<double> cosines_, sines_;  // of each direction
  std::vector<std::int32_t> cells_;      // offsets of one direction after the other
  std::vector<std::uint8_t> voting_;     // whether point i of the cluster does
  std::size_t first_ = 0;                // of the cluster
  std::size_t offsets_ = 1;              // for each direction
  double x_ = 0.0, y_ = 0.0;             // [m] middle
  double lowest_ = 0.0;                  // [m] distance where the first cell begins
  double width_ = 1.0;                   // [m]
};

/// Hough transform (Duda and Hart 1972), peak after peak: the points of a cluster vote for the
/// lines (alpha, r) through them; the longest run of free points near the line with most votes is
/// fitted again and taken, and its votes are taken back, until no line has enough. A peak without a
/// long run is a chance alignment: it is passed over and its longest run votes no more, but the
/// points remain free for runs near other lines.
class Hough {
 public:
  static constexpr const char* name = "hough";
  static constexpr const char* description =
      "Hough transform: takes the longest run near the line that most points vote for";
  static constexpr const char* source = "Duda and Hart 1972; Nguyen et al. 2007";
  static constexpr const char* choose =
      "At up to 20 mm when false segments must be few: nearly all walls are found with few errors. "
      "It is among the slowest, and at 50 mm it misses more walls than iepf.";

  struct Parameters : SegmentationParameters {
    double angle_resolution = 0.03490658503988659;  // [rad] 2 deg
    double offset_resolution = 0.04;                // [m]

    static constexpr auto fields() {
      using P = Parameters;
      return std::tuple_cat(
          std::make_tuple(field<P, double>(&P::angle_resolution, "angle_resolution", "rad", 0.003,
                                           0.5, "width of a cell in the direction of the line"),
                          field<P, double>(&P::offset_resolution, "offset_resolution", "m", 0.002,
                                           1.0, "width of a cell in the distance of the line")),
          common_fields<P>());
    }
  };

  Hough() : Hough(Parameters{}) {}
  explicit Hough(const Parameters& parameters);

  void operator()(const PointsView& scan, const SensorModel& sensor, Segmentation& found);

 private:
  void search(const PointsView& points, const Segment& cluster);
  /// The free range with the longest run near the line, and that run.
  [[nodiscard]] Segment best_run(const PointsView& points, const NormalLine& line,
                                 std::size_t& range) const;

  std::size_t fewest_;  // points of a line
  double offset_resolution_;
  SegmentBuilder builder_;
  PrefixMoments moments_;
  HoughVotes votes_;
  std::vector<Segment> free_;   // ranges of the cluster that are in no run, ascending
  std::vector<Segment> found_;  // in the cluster
};

}  // namespace quoin
