// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/segmentation/runs.hpp"

namespace quoin {
namespace {

constexpr int most_refinements = 10;

}  // namespace

double excess_of(const NormalLine& line, const PointsView& points, std::size_t i,
                 const Tolerance& tolerance) {
  const double distance = line.distance(points.x[i], points.y[i]);
  return distance * distance / tolerance.squared(points, i, line.normal_x, line.normal_y);
}

Segment run_around(const PointsView& points, const Segment& range, std::size_t inside,
                   const NormalLine& line, const Tolerance& tolerance) {
  if (excess_of(line, points, inside, tolerance) > 1.0) return {inside, inside};
  // Counts the points on the line from `inside` on, up to the last before a gap.
  const auto reach = [&](std::size_t available, auto index) {
    std::size_t reached = 0;
    for (std::size_t k = 1; k <= available; ++k) {
      const double excess = excess_of(line, points, index(k), tolerance);
      if (excess <= 1.0) {
        reached = k;
      } else if (excess > largest_outlier || k - reached > largest_gap_in_run) {
        break;
      }
    }
    return reached;
  };
  const std::size_t ahead =
      reach(range.end - 1 - inside, [inside](std::size_t k) { return inside + k; });
  const std::size_t behind =
      reach(inside - range.begin, [inside](std::size_t k) { return inside - k; });
  return {inside - behind, inside + ahead + 1};
}

Segment longest_run(const PointsView& points, const Segment& range, const NormalLine& line,
                    const Tolerance& tolerance) {
  Segment longest{range.begin, range.begin};
  for (std::size_t i = range.begin; i < range.end;) {
    const Segment run = run_around(points, {i, range.end}, i, line, tolerance);
    if (run.size() > longest.size()) longest = run;
    i = run.end + 1;
  }
  return longest;
}

Segment refined_run(const PointsView& points, const PrefixMoments& moments, const Segment& range,
                    const Segment& run, const Tolerance& tolerance) {
  Segment refined = run;
  for (int k = 0; k < most_refinements && refined.size() > 0; ++k) {
    const auto fit = orthogonal_fit(moments(refined.begin, refined.end));
    if (!fit) break;
    const std::size_t middle = refined.begin + refined.size() / 2;
    Segment next = run_around(points, range, middle, fit->line, tolerance);
    if (next.size() == 0) next = longest_run(points, refined, fit->line, tolerance);
    if (next == refined) break;
    refined = next;
  }
  return refined;
}

Segment straight_run(const PointsView& points, const PrefixMoments& moments, const Segment& piece,
                     const Tolerance& tolerance) {
  const auto fit = orthogonal_fit(moments(piece.begin, piece.end));
  if (!fit) return {piece.begin, piece.begin};
  const Segment longest = longest_run(points, piece, fit->line, tolerance);
  return refined_run(points, moments, piece, longest, tolerance);
}

}  // namespace quoin
