// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

namespace quoin {

/// Standard deviations of a 2D LiDAR. Noise is independent from ray to ray and averages out; bias
/// is common to all rays of a scan and does not, so the two are kept apart.
struct SensorModel {
  double range_stddev = 0.010;  ///< [m] noise of each range
  double bearing_stddev =
      0.00197;  ///< [rad] noise of each bearing (0.113 deg: 0.391 deg steps, uniform)
  double range_bias_stddev = 0.0;  ///< [m] error common to all ranges; 0 when unknown or calibrated
  /// Noise of a range that grows with it, without unit: the variance of a range rho is
  /// range_stddev^2 + (range_stddev_per_metre rho)^2.
  double range_stddev_per_metre = 0.0;
  /// [m] how far a wall is off a line by itself, over lengths that many rays share: it does not
  /// average out with their number.
  double flatness_stddev = 0.0;

  /// Variance [m^2] of a range [m].
  [[nodiscard]] double range_variance(double range) const {
    const double growing = range_stddev_per_metre * range;
    return range_stddev * range_stddev + growing * growing;
  }
};

/// Points of a scan in polar and Cartesian form, structure of arrays, all of the same length. A
/// view: it does not own the arrays.
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
  /// The points without those at these indices, which are ascending.
  void assign_without(std::span<const std::size_t> left_out, const PointsView& points);
  /// Leaves out the points at these indices, which are ascending.
  void erase(std::span<const std::size_t> left_out);
  [[nodiscard]] std::size_t size() const { return range.size(); }
  [[nodiscard]] PointsView view() const {
    return {range, bearing, inverse_range, cosine, sine, x, y};
  }
  operator PointsView() const { return view(); }  // NOLINT(google-explicit-constructor)
};

/// Squared distance [m^2] of points `i` and `j`.
[[nodiscard]] inline double squared_distance(const PointsView& points, std::size_t i,
                                             std::size_t j) {
  const double dx = points.x[j] - points.x[i];
  const double dy = points.y[j] - points.y[i];
  return dx * dx + dy * dy;
}

/// Sine of the angle from the bearing of point `i` to that of point `j`.
[[nodiscard]] inline double sine_between(const PointsView& points, std::size_t i, std::size_t j) {
  return points.cosine[i] * points.sine[j] - points.sine[i] * points.cosine[j];
}

/// Leaves out the values at these indices, which are ascending.
template <class T>
void erase_at(std::span<const std::size_t> left_out, std::vector<T>& values) {
  if (left_out.empty()) return;
  T* kept = values.data() + left_out.front();
  for (std::size_t k = 0; k < left_out.size(); ++k) {
    const std::size_t end = k + 1 < left_out.size() ? left_out[k + 1] : values.size();
    kept = std::copy(values.data() + left_out[k] + 1, values.data() + end, kept);
  }
  values.resize(values.size() - left_out.size());
}

/// Points of a scan in single precision, which is micrometres: enough to see where a surface ends
/// or a chord is left, in half the time. Lines are fitted in double precision. Keeps its memory.
struct CoarsePoints {
  std::vector<float> range, x, y;  ///< [m]

  void assign(const PointsView& points);
  /// Leaves out the points at these indices, which are ascending.
  void erase(std::span<const std::size_t> left_out);
  [[nodiscard]] std::size_t size() const { return range.size(); }
};

/// Largest bearing [rad] whose sine and cosine `compute_cartesian` gives to full accuracy, either
/// sign. A larger one is not a bearing.
inline constexpr double largest_bearing = 1e6;

/// Fills inverse_range, cosine, sine, x and y from range and bearing. Sine and cosine are exact to
/// 2 units in the last place (to 3e-16 near their zeros), much faster than calling std::sin and
/// std::cos in turn.
void compute_cartesian(Points& points);

/// The same for the points from index `at` on, whose bearing and range are these; both spans have
/// the same length, and the points have room for them.
void compute_cartesian(std::span<const float> bearings, std::span<const float> ranges,
                       std::size_t at, Points& points);

/// Points that are already valid, ordered and rotated (by `convert`, before they were sent), with
/// sine, cosine and Cartesian coordinates computed.
void convert_ordered(std::span<const float> bearings, std::span<const float> ranges,
                     Points& points);

}  // namespace quoin
