// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <tuple>
#include <vector>

#include "core/parameters/parameter.hpp"
#include "core/sensor/points.hpp"

namespace quoin {

/// Points [begin, end) of a scan that lie on one straight wall.
struct Segment {
  std::size_t begin = 0;
  std::size_t end = 0;

  [[nodiscard]] std::size_t size() const { return end - begin; }
  friend bool operator==(const Segment&, const Segment&) = default;
};

/// Splits the points of a scan (as `convert` made them) into ascending, disjoint segments. The
/// vector is cleared first and keeps its memory. May keep working memory between calls.
using Segmenter = std::function<void(const PointsView&, const SensorModel&, std::vector<Segment>&)>;

/// The parameters of every segmenter. A method's own `Parameters` derive from this and append their
/// fields to `common_fields<Parameters>()`.
struct SegmentationParameters {
  double split_distance = 0.05;  // [m]
  double noise_factor = 4.0;     // standard deviations
  int min_points = 6;
  double min_length = 0.2;                        // [m]
  double max_bend = 0.05;                         // sagitta over length
  double breakpoint_angle = 0.17453292519943295;  // [rad] 10 deg
  bool merge = true;
  bool refine = true;

  template <class Owner>
  static constexpr auto common_fields() {
    using P = SegmentationParameters;
    return std::make_tuple(
        field<Owner, double>(&P::split_distance, "split_distance", "m", 0.001, 0.5,
                             "largest distance of a point from the line of its segment"),
        field<Owner, double>(&P::noise_factor, "noise_factor", "", 0.0, 20.0,
                             "that distance is raised to so many standard deviations of the noise "
                             "across the line, from the sensor model at the point's range"),
        field<Owner, int>(&P::min_points, "min_points", "", 2, 10000,
                          "segments with fewer points are dropped"),
        field<Owner, double>(
            &P::min_length, "min_length", "m", 0.0, 100.0,
            "shorter segments are dropped; half of it is enough beside one that is longer"),
        field<Owner, double>(&P::max_bend, "max_bend", "", 0.0, 1.0,
                             "segments whose sagitta is a larger part of their length, more than "
                             "noise explains, are round things and dropped"),
        field<Owner, double>(
            &P::breakpoint_angle, "breakpoint_angle", "rad", 0.01, 1.5,
            "walls met at a smaller grazing angle fall apart; larger steps of the bearing break"),
        field<Owner, bool>(&P::merge, "merge",
                           "join neighbours that are one line within the noise"),
        field<Owner, bool>(&P::refine, "refine", "move boundaries to the corners of fitted lines"));
  }
};

}  // namespace quoin
