// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <tuple>
#include <utility>
#include <vector>

#include "core/methods/parameter.hpp"
#include "core/segmentation/breakpoints.hpp"
#include "core/segmentation/refinement.hpp"
#include "core/segmentation/segment.hpp"

namespace quoin {

/// Iterative end point fit (Duda and Hart 1973) behind an adaptive breakpoint detector: each
/// cluster is split at the point farthest from the chord between its ends until no point is farther
/// than `split_distance`, which should be at least 4 to 5 standard deviations of the noise. Then,
/// unless switched off, the boundaries are refined (see refinement.hpp).
class Iepf {
 public:
  static constexpr const char* name = "iepf";
  static constexpr const char* description =
      "iterative end point fit with adaptive break points and refined boundaries";
  static constexpr const char* source = "Duda and Hart 1973; Borges and Aldon 2004";

  struct Parameters {
    double split_distance = 0.05;  // [m]
    int min_points = 6;
    double min_length = 0.1;                        // [m]
    double breakpoint_angle = 0.17453292519943295;  // [rad] 10 deg
    bool refine = true;

    static constexpr auto fields() {
      return std::make_tuple(
          field(&Parameters::split_distance, "split_distance", "m", 0.001, 0.5,
                "largest distance of a point from the chord of its segment"),
          field(&Parameters::min_points, "min_points", "", 2, 10000,
                "segments with fewer points are dropped"),
          field(&Parameters::min_length, "min_length", "m", 0.0, 100.0,
                "shorter segments are dropped"),
          field(
              &Parameters::breakpoint_angle, "breakpoint_angle", "rad", 0.01, 1.5,
              "walls met at a smaller grazing angle fall apart; larger steps of the bearing break"),
          field(&Parameters::refine, "refine",
                "move boundaries to the corners of fitted lines and join collinear neighbours"));
    }
  };

  Iepf() : Iepf(Parameters{}) {}
  explicit Iepf(const Parameters& parameters);

  void operator()(const PointsView& points, const SensorModel& sensor,
                  std::vector<Segment>& segments);

 private:
  void split(const PointsView& points, std::size_t begin, std::size_t end);

  Parameters parameters_;
  BreakpointDetector breakpoints_;
  std::vector<std::size_t> starts_;
  std::vector<std::pair<std::size_t, std::size_t>> stack_;  // chords still to be judged
  std::vector<Piece> pieces_;
};

}  // namespace quoin
