// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <tuple>
#include <vector>

#include "core/segmentation/runs.hpp"
#include "core/segmentation/segment_builder.hpp"

namespace quoin {

/// Line regression (Arras and Siegwart 1998): lines fitted in a sliding window, and a segment where
/// neighbouring windows have the same line. Compared are the windows before and behind each point,
/// by the Mahalanobis distance of their two lines: for equal noise that is how much the squared
/// residuals rise, in variances, when one line must serve both. Where it peaks above the limit a
/// segment ends. What belongs together after all is joined by the shared merging.
class LineRegression {
 public:
  static constexpr const char* name = "line_regression";
  static constexpr const char* description =
      "line regression: splits where lines fitted in a sliding window change";
  static constexpr const char* source = "Arras and Siegwart 1998; Nguyen et al. 2007";
  static constexpr const char* choose =
      "To compare with the literature, or at a few millimetres of noise, where it makes fewer "
      "errors than iepf. From 20 mm on it does not, and it takes many times as long.";

  struct Parameters : SegmentationParameters {
    int window = 12;
    double change = 12.0;

    static constexpr auto fields() {
      using P = Parameters;
      return std::tuple_cat(
          std::make_tuple(
              field<P, int>(&P::window, "window", "", 3, 1000, "points a line is fitted to"),
              field<P, double>(&P::change, "change", "", 0.1, 10000.0,
                               "squared Mahalanobis distance of two lines that are not the same; "
                               "chi square with two degrees of freedom for one that is")),
          common_fields<P>());
    }
  };

  LineRegression() : LineRegression(Parameters{}) {}
  explicit LineRegression(const Parameters& parameters);

  void operator()(const PointsView& scan, const SensorModel& sensor, Segmentation& found);

 private:
  void compare_windows(const Segment& cluster);
  /// Adds what is straight of a piece.
  void add(const PointsView& points, const Segment& piece);

  std::size_t window_;
  double change_;
  SegmentBuilder builder_;
  PrefixMoments moments_;
  StraightRuns straight_runs_;
  std::vector<double> distance_;  // of the lines before and from point i on
};

}  // namespace quoin
