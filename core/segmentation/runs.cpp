// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/segmentation/runs.hpp"

#include <algorithm>
#include <cmath>

namespace quoin {
namespace {

constexpr int most_refinements = 10;
constexpr std::size_t fewest_in_run = 3;

/// Sum over the points, of their orthogonal line.
double squared_residuals(const Moments& moments) {
  const OrthogonalLine fit = orthogonal_line(moments);
  return fit.ok() ? fit.across : 0.0;
}

}  // namespace

void PrefixMoments::assign(const PointsView& points) {
  sums_.resize(points.size() + 1);
  Moments sum;
  sums_[0] = sum;
  for (std::size_t i = 0; i < points.size(); ++i) {
    sum.add(points.x[i], points.y[i]);
    sums_[i + 1] = sum;
  }
}

Moments PrefixMoments::operator()(std::size_t begin, std::size_t end) const {
  Moments moments = sums_[end];
  moments -= sums_[begin];
  return moments;
}

std::optional<double> squared_mahalanobis(const Moments& first, const Moments& second,
                                          const Tolerance& tolerance) {
  Moments both = first;
  both += second;
  const OrthogonalLine fit = orthogonal_line(both);
  if (!fit.ok()) return std::nullopt;
  const double rise = fit.across - squared_residuals(first) - squared_residuals(second);
  const double x = fit.moments.mean_x;
  const double y = fit.moments.mean_y;
  const double range = std::sqrt(x * x + y * y);
  if (!(range > 0.0)) return std::nullopt;
  return rise * deviations_in_tolerance * deviations_in_tolerance /
         tolerance.squared(fit.line.offset / range, fit.line.offset, fit.line.along(x, y));
}

bool is_peak(std::span<const double> values, const Segment& range, std::size_t i, std::size_t reach,
             double limit) {
  if (!(values[i] > limit)) return false;
  const std::size_t first = i - std::min(reach, i - range.begin);
  const std::size_t end = i + 1 + std::min(reach, range.end - i - 1);
  for (std::size_t k = first; k < i; ++k) {
    if (values[k] >= values[i]) return false;
  }
  for (std::size_t k = i + 1; k < end; ++k) {
    if (values[k] > values[i]) return false;
  }
  return true;
}

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
    const OrthogonalLine fit = orthogonal_line(moments(refined.begin, refined.end));
    if (!fit.ok()) break;
    const std::size_t middle = refined.begin + refined.size() / 2;
    Segment next = run_around(points, range, middle, fit.line, tolerance);
    if (next.size() == 0) next = longest_run(points, refined, fit.line, tolerance);
    if (next == refined) break;
    refined = next;
  }
  return refined;
}

Segment straight_run(const PointsView& points, const PrefixMoments& moments, const Segment& piece,
                     const Tolerance& tolerance) {
  const OrthogonalLine fit = orthogonal_line(moments(piece.begin, piece.end));
  if (!fit.ok()) return {piece.begin, piece.begin};
  const Segment longest = longest_run(points, piece, fit.line, tolerance);
  return refined_run(points, moments, piece, longest, tolerance);
}

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
