// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/segmentation/moment_sums.hpp"
#include "core/segmentation/segment.hpp"
#include "core/segmentation/tolerance.hpp"
#include "core/sensor/points.hpp"

namespace quoin {

/// Takes pieces apart that methods which look at neighbours only believe to be one line, such as an
/// arc or walls at a blunt corner. Keeps its memory.
class StraightRuns {
 public:
  /// The straight run of a piece, that of what is before it, and so on: ascending, of at least 3
  /// points each; the piece itself when it is straight. Valid until the next call.
  [[nodiscard]] std::span<const Segment> find(const PointsView& points,
                                              const PrefixMoments& moments, const Segment& piece,
                                              const Tolerance& tolerance);

 private:
  struct Candidate {
    Segment segment;
    bool straight = false;
  };
  std::vector<Candidate> stack_;  // still to be judged, the leftmost on top
  std::vector<Segment> runs_;
};

}  // namespace quoin
