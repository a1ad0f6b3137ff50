// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "core/fitting/orthogonal.hpp"
#include "core/segmentation/segment.hpp"
#include "core/segmentation/tolerance.hpp"
#include "core/sensor/points.hpp"

namespace quoin {

/// Running sums over the points of a scan, which give the moments of any run of them at once.
class PrefixMoments {
 public:
  void assign(const PointsView& points);

  /// Of points [begin, end).
  [[nodiscard]] Moments operator()(std::size_t begin, std::size_t end) const;

 private:
  std::vector<Moments> sums_;  // of the points before i
};

/// Squared Mahalanobis distance of the lines of two sets of points. For equal noise it is how much
/// the sum of squared residuals rises, in variances, when one line must serve both; chi square with
/// two degrees of freedom when they are the same. Nothing when both together have no line.
[[nodiscard]] std::optional<double> squared_mahalanobis(const Moments& first, const Moments& second,
                                                        const Tolerance& tolerance);

/// Whether value `i` is above `limit` and the largest of those up to `reach` indices away inside
/// `range`; of equal ones the first is.
[[nodiscard]] bool is_peak(std::span<const double> values, const Segment& range, std::size_t i,
                           std::size_t reach, double limit);

/// Squared distance of point `i` from the line in units of its squared tolerance.
[[nodiscard]] double excess_of(const NormalLine& line, const PointsView& points, std::size_t i,
                               const Tolerance& tolerance);

/// Squared, in squared tolerances: outliers beyond it end a run, for a segment keeps all its points
/// and no fit of it would be right.
inline constexpr double largest_outlier = 4.0;

/// Points off the line that a run may pass over at a time.
inline constexpr std::size_t largest_gap_in_run = 2;

/// The points around point `inside` that are within their tolerance of the line without a gap,
/// inside `range`. Mild outliers are passed over when points on the line follow. Empty
/// when that point itself is off the line.
[[nodiscard]] Segment run_around(const PointsView& points, const Segment& range, std::size_t inside,
                                 const NormalLine& line, const Tolerance& tolerance);

/// The longest of all such runs in `range`.
[[nodiscard]] Segment longest_run(const PointsView& points, const Segment& range,
                                  const NormalLine& line, const Tolerance& tolerance);

/// The run that its own fitted line has around its middle, or the longest where the middle is off
/// the line, fitted again until it stays.
[[nodiscard]] Segment refined_run(const PointsView& points, const PrefixMoments& moments,
                                  const Segment& range, const Segment& run,
                                  const Tolerance& tolerance);

/// The straight run of a piece: the longest near the line of all its points, refined inside it.
[[nodiscard]] Segment straight_run(const PointsView& points, const PrefixMoments& moments,
                                   const Segment& piece, const Tolerance& tolerance);

/// Splits pieces that are not straight although methods which compare neighbours only take them for
/// one line, such as an arc or walls at a blunt corner. Keeps its memory.
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
  std::vector<Candidate> stack_;  // still to be examined, the leftmost on top
  std::vector<Segment> runs_;
};

}  // namespace quoin
