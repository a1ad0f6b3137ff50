// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <tuple>
#include <vector>

#include "core/segmentation/runs.hpp"
#include "core/segmentation/segment_builder.hpp"
#include "core/simulation/random.hpp"

namespace quoin {

/// Random sample consensus (Fischler and Bolles 1981), line after line: of the lines through two
/// random points that are near each other, the one with the most consecutive points within their
/// tolerance is fitted again, and its run taken out, until no run is long enough. The points before
/// and behind a run are searched apart from each other. Seeded anew for each scan.
class Ransac {
 public:
  static constexpr const char* name = "ransac";
  static constexpr const char* description =
      "random sample consensus: takes the longest run near a line through two random points";
  static constexpr const char* source = "Fischler and Bolles 1981; Nguyen et al. 2007";
  static constexpr const char* choose =
      "At up to 10 mm when false segments must be few and time does not matter. Not at 50 mm, "
      "where it misses a large part of the walls; there is chance in it, though the same seed "
      "gives the same result.";

  struct Parameters : SegmentationParameters {
    int trials = 60;
    int sample_spread = 20;
    int seed = 1;

    static constexpr auto fields() {
      using P = Parameters;
      return std::tuple_cat(
          std::make_tuple(
              field<P, int>(&P::trials, "trials", "", 1, 10000, "pairs of points tried for a line"),
              field<P, int>(&P::sample_spread, "sample_spread", "", 1, 10000,
                            "the two points of a pair are at most so many points apart"),
              field<P, int>(&P::seed, "seed", "", 0, 1000000000, "of the random numbers")),
          common_fields<P>());
    }
  };

  Ransac() : Ransac(Parameters{}) {}
  explicit Ransac(const Parameters& parameters);

  void operator()(const PointsView& scan, const SensorModel& sensor, Segmentation& found);

 private:
  /// The best run inside `range`, empty when there is none.
  [[nodiscard]] Segment search(const PointsView& points, const Segment& range,
                               Random& random) const;

  Parameters parameters_;
  SegmentBuilder builder_;
  PrefixMoments moments_;
  std::vector<Segment> stack_;  // still to be searched
  std::vector<Segment> found_;  // in the cluster
};

}  // namespace quoin
