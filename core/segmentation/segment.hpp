// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <tuple>
#include <vector>

#include "core/parameters/parameter.hpp"
#include "core/sensor/points.hpp"

namespace quoin {

struct SegmentationTrace;

/// Points [begin, end) of a scan, such as those on one straight wall.
struct Segment {
  std::size_t begin = 0;
  std::size_t end = 0;

  [[nodiscard]] std::size_t size() const { return end - begin; }
  friend bool operator==(const Segment&, const Segment&) = default;
};

/// The order of disjoint runs along a scan.
[[nodiscard]] inline bool begins_before(const Segment& a, const Segment& b) {
  return a.begin < b.begin;
}

/// What a segmenter finds in a scan.
struct Segmentation {
  std::vector<Segment> segments;  ///< straight walls: ascending, disjoint
  /// Round surfaces: ascending, apart from the segments but for those all of whose points are
  /// foreign, such as a leg in front of a wall.
  std::vector<Segment> arcs;
  std::vector<std::size_t> foreign;  ///< ascending: points inside of them that are not on them
  std::size_t no_return = 0;         ///< points with what the sensor writes where nothing came back
  /// The work for one scan reached its bound, which scans of rooms do not: walls may be in pieces.
  bool cut_short = false;
  /// Where it is to be said what became of each point; usually nowhere, and then nobody asks.
  SegmentationTrace* trace = nullptr;

  void clear() {
    segments.clear();
    arcs.clear();
    foreign.clear();
    no_return = 0;
    cut_short = false;
  }
};

/// Where a run is once the points at these indices, which are ascending, are left out.
[[nodiscard]] Segment without(std::span<const std::size_t> left_out, const Segment& run);

/// Moves the foreign points behind all others, where they keep their order, so that segments and
/// arcs have no other points than their own and are apart; `foreign` becomes the last points.
void set_aside(Points& points, Segmentation& found);

/// Finds what is in the points of a scan (as `convert` made them). The result is cleared first and
/// keeps its memory. May keep working memory between calls.
using Segmenter = std::function<void(const PointsView&, const SensorModel&, Segmentation&)>;

/// The parameters of every segmenter. A method's own `Parameters` derive from this and append their
/// fields to `common_fields<Parameters>()`.
struct SegmentationParameters {
  double split_distance = 0.05;  // [m]
  double flatness = 0.01;        // [m]
  double noise_factor = 4.0;     // standard deviations
  int min_points = 6;
  double min_length = 0.25;                       // [m]
  double max_bend = 0.05;                         // sagitta over length
  double max_line_gap = 0.4;                      // [m]
  double breakpoint_angle = 0.17453292519943295;  // [rad] 10 deg
  bool merge = true;
  bool refine = true;

  template <class Owner>
  static constexpr auto common_fields() {
    using P = SegmentationParameters;
    return std::make_tuple(
        field<Owner, double>(&P::split_distance, "split_distance", "m", 0.001, 0.5,
                             "distance from the line at which a wall is first split"),
        field<Owner, double>(
            &P::flatness, "flatness", "m", 0.0, 0.5,
            "points farther off a wall are not of it; walls are flat to within this "
            "distance, short ones to 1 % of their length"),
        field<Owner, double>(
            &P::noise_factor, "noise_factor", "", 0.0, 20.0,
            "both distances are raised to so many standard deviations of the noise "
            "across the line, from the sensor model at the point's range"),
        field<Owner, int>(&P::min_points, "min_points", "", 2, 10000,
                          "segments with fewer points are dropped"),
        field<Owner, double>(
            &P::min_length, "min_length", "m", 0.0, 100.0,
            "shorter segments are dropped; half of it is enough beside one that is longer"),
        field<Owner, double>(&P::max_bend, "max_bend", "", 0.0, 1.0,
                             "segments whose sagitta is a larger part of their length, more than "
                             "noise explains, are round things and dropped"),
        field<Owner, double>(&P::max_line_gap, "max_line_gap", "m", 0.0, 100.0,
                             "a wall goes on behind something in front of it, or where rays are "
                             "missing, over at most this distance"),
        field<Owner, double>(
            &P::breakpoint_angle, "breakpoint_angle", "rad", 0.01, 1.5,
            "walls met at a smaller grazing angle fall apart; larger steps of the bearing break"),
        field<Owner, bool>(&P::merge, "merge",
                           "join neighbours that are one line within the noise"),
        field<Owner, bool>(&P::refine, "refine", "move boundaries to the corners of fitted lines"));
  }
};

}  // namespace quoin
