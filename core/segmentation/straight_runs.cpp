// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/segmentation/straight_runs.hpp"

#include "core/segmentation/runs.hpp"

namespace quoin {
namespace {

constexpr std::size_t fewest_in_run = 3;

}  // namespace

std::span<const Segment> StraightRuns::find(const PointsView& points, const PrefixMoments& moments,
                                            const Segment& piece, const Tolerance& tolerance) {
  runs_.clear();
  stack_.clear();
  stack_.push_back({piece, false});
  while (!stack_.empty()) {
    const Candidate candidate = stack_.back();
    stack_.pop_back();
    const Segment& range = candidate.segment;
    if (candidate.straight) {
      runs_.push_back(range);
      continue;
    }
    const Segment run = straight_run(points, moments, range, tolerance);
    if (run.size() < fewest_in_run) continue;
    stack_.push_back({{run.end, range.end}, false});
    stack_.push_back({run, true});
    stack_.push_back({{range.begin, run.begin}, false});
  }
  return runs_;
}

}  // namespace quoin
