// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <tuple>
#include <vector>

#include "core/segmentation/line_mixture.hpp"
#include "core/segmentation/moment_sums.hpp"
#include "core/segmentation/segment_builder.hpp"

namespace quoin {

/// Expectation maximisation (Liu et al. 2001): a mixture of lines and a uniform background is
/// fitted to the points of each cluster, starting from lines through evenly spread windows. In
/// turns, each point belongs to the lines by their densities at it, and each line is the total
/// least squares line of its points by these weights. Runs of points that most probably are of one
/// line are its segments. The start leaves nothing to chance, so there is no seed.
class ExpectationMaximization {
 public:
  static constexpr const char* name = "expectation_maximization";
  static constexpr const char* description =
      "expectation maximisation: fits a mixture of lines and a background to each cluster";
  static constexpr const char* source = "Liu et al. 2001; Nguyen et al. 2007";
  static constexpr const char* choose =
      "At 50 mm when finding the walls is worth any time: there it finds most. It is the slowest, "
      "and makes hardly fewer errors than iepf.";

  struct Parameters : SegmentationParameters {
    int window = 8;
    int lines = 120;
    int iterations = 10;

    static constexpr auto fields() {
      using P = Parameters;
      return std::tuple_cat(
          std::make_tuple(
              field<P, int>(&P::window, "window", "", 3, 1000, "points each line starts from"),
              field<P, int>(&P::lines, "lines", "", 1, 1000,
                            "most lines of a cluster; the windows grow accordingly"),
              field<P, int>(&P::iterations, "iterations", "", 1, 1000,
                            "steps of expectation and maximisation")),
          common_fields<P>());
    }
  };

  ExpectationMaximization() : ExpectationMaximization(Parameters{}) {}
  explicit ExpectationMaximization(const Parameters& parameters);

  void operator()(const PointsView& points, const SensorModel& sensor,
                  std::vector<Segment>& segments);

 private:
  void add_runs(const PointsView& points, const Segment& cluster);

  Parameters parameters_;
  std::size_t fewest_;  // points of a line
  SegmentBuilder builder_;
  PrefixMoments moments_;
  LineMixture mixture_;
  std::vector<std::size_t> labels_;  // the line of each point of the cluster
};

}  // namespace quoin
