// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace quoin {

/// Points of a scan in polar and Cartesian form, structure of arrays, all of the same length. A
/// view: the arrays belong to somebody else.
struct PointsView {
  std::span<const double> range;          ///< [m] > 0, finite
  std::span<const double> bearing;        ///< [rad] counter-clockwise from x
  std::span<const double> inverse_range;  ///< [1/m] 1 / range
  std::span<const double> cosine;         ///< cos(bearing)
  std::span<const double> sine;           ///< sin(bearing)
  std::span<const double> x;              ///< [m]
  std::span<const double> y;              ///< [m]

  [[nodiscard]] std::size_t size() const { return range.size(); }

  /// Points [begin, end).
  [[nodiscard]] PointsView subview(std::size_t begin, std::size_t end) const {
    const std::size_t count = end - begin;
    return {range.subspan(begin, count),
            bearing.subspan(begin, count),
            inverse_range.subspan(begin, count),
            cosine.subspan(begin, count),
            sine.subspan(begin, count),
            x.subspan(begin, count),
            y.subspan(begin, count)};
  }
};

/// Owner of the arrays; keeps its memory from scan to scan.
struct Points {
  std::vector<double> range, bearing, inverse_range, cosine, sine, x, y;
  std::vector<float> scan_bearing, scan_range;  ///< working memory of `convert`

  void resize(std::size_t count);
  [[nodiscard]] std::size_t size() const { return range.size(); }
  [[nodiscard]] PointsView view() const {
    return {range, bearing, inverse_range, cosine, sine, x, y};
  }
  operator PointsView() const { return view(); }  // NOLINT(google-explicit-constructor)
};

}  // namespace quoin
