// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "core/segmentation/segment_builder.hpp"

namespace quoin {

/// Iterative end point fit (Duda and Hart 1973): each cluster is split at the point farthest from
/// the chord between its ends, in units of its tolerance, until none is beyond it. The tolerance
/// should be at least 4 to 5 standard deviations of the noise.
class Iepf {
 public:
  static constexpr const char* name = "iepf";
  static constexpr const char* description =
      "iterative end point fit: splits at the point farthest from the chord";
  static constexpr const char* source = "Duda and Hart 1973; Borges and Aldon 2004";
  static constexpr const char* choose =
      "For nearly everything: the fastest at low noise, and among those that find most at 50 mm. "
      "From 20 mm on some of what it finds is none; successive_edge_following and line_tracking "
      "make fewer such errors.";

  struct Parameters : SegmentationParameters {
    static constexpr auto fields() { return common_fields<Parameters>(); }
  };

  Iepf() : Iepf(Parameters{}) {}
  explicit Iepf(const Parameters& parameters);

  void operator()(const PointsView& scan, const SensorModel& sensor, Segmentation& found);

 private:
  void split(const PointsView& points, const Segment& cluster);

  struct Chord {
    Segment segment;
    std::size_t depth = 0;  // of splits
  };

  SegmentBuilder builder_;
  std::vector<Chord> waiting_;  // right of the one being judged, the leftmost last
};

}  // namespace quoin
