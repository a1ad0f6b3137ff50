// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/segmentation/segment.hpp"

#include <algorithm>

namespace quoin {
namespace {

/// `moved` holds the ascending indices.
void move_behind(const std::vector<std::size_t>& moved, std::vector<double>& values) {
  for (const std::size_t i : moved) values.push_back(values[i]);
  erase_at<double>(moved, values);
}

}  // namespace

Segment without(std::span<const std::size_t> left_out, const Segment& run) {
  const auto before = [left_out](std::size_t i) {
    return static_cast<std::size_t>(std::lower_bound(left_out.begin(), left_out.end(), i) -
                                    left_out.begin());
  };
  return {run.begin - before(run.begin), run.end - before(run.end)};
}

void set_aside(Points& points, Segmentation& found) {
  if (found.foreign.empty()) return;
  for (std::vector<double>* values : {&points.range, &points.bearing, &points.inverse_range,
                                      &points.cosine, &points.sine, &points.x, &points.y}) {
    move_behind(found.foreign, *values);
  }
  const std::size_t first = points.size() - found.foreign.size();
  for (Segment& run : found.segments) run = without(found.foreign, run);
  for (Segment& run : found.arcs) {
    const auto at = std::lower_bound(found.foreign.begin(), found.foreign.end(), run.begin);
    const bool is_foreign = at != found.foreign.end() && *at == run.begin;
    const std::size_t moved =
        first + static_cast<std::size_t>(at - found.foreign.begin());  // of its first point
    run = is_foreign ? Segment{moved, moved + run.size()} : without(found.foreign, run);
  }
  std::sort(found.arcs.begin(), found.arcs.end(), begins_before);
  for (std::size_t k = 0; k < found.foreign.size(); ++k) found.foreign[k] = first + k;
}

}  // namespace quoin
