// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/corners/adjacent.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/geometry/angle.hpp"
#include "core/sensor/points.hpp"

namespace quoin {
namespace {

/// Of two lines whose normals have these directions in (-pi, pi]; in [0, pi / 2].
double angle_between(double first, double second) {
  double angle = std::abs(first - second);
  if (angle > pi) angle = 2.0 * pi - angle;
  return angle > 0.5 * pi ? pi - angle : angle;
}

/// From one vector to the other, counter-clockwise positive; in (-pi, pi] [rad].
double angle_to(const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
  return std::atan2(from.x() * to.y() - from.y() * to.x(), from.dot(to));
}

/// Between the rays of a line [rad]; 0 when unknown.
double ray_step(const LineSegment& line) {
  if (line.points < 2) return 0.0;
  return std::abs(angle_to(line.start, line.end)) / static_cast<double>(line.points - 1);
}

/// Like `angle_to`, where it is small: its tangent. Infinite from a right angle on.
double small_angle_to(const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
  const double along = from.dot(to);
  const double across = from.x() * to.y() - from.y() * to.x();
  return along > 0.0 ? across / along
                     : std::copysign(std::numeric_limits<double>::infinity(), across);
}

// From the last ray of a wall to its corner. Segmenters leave out the point next to a corner, and a
// few more may be strays.
constexpr double steps_to_corner = 5.0;
// Of the bearing of a corner, which may lie that far inside a wall, and a ray that was taken for
// one of the other wall.
constexpr double inside_deviations = 3.0;
constexpr double inside_steps = 1.0;

/// Standard deviation of the bearing of a point [rad].
double bearing_stddev(const CornerEstimate& corner) {
  const Eigen::Vector2d& position = corner.position;
  const Eigen::Vector2d across(-position.y(), position.x());
  return std::sqrt(std::max(0.0, across.dot(corner.covariance * across))) / position.squaredNorm();
}

/// In (0, 2 pi), clockwise from the first wall over the sensor's side to the second.
double opening_of(const Eigen::Vector2d& corner, const LineSegment& first,
                  const LineSegment& second) {
  const double opening = angle_to(second.end - corner, first.start - corner);
  return opening > 0.0 ? opening : opening + 2.0 * pi;
}

}  // namespace

Adjacent::Adjacent(const Parameters& parameters)
    : parameters_(parameters), sine_of_min_angle_(std::sin(parameters.min_angle)) {}

std::optional<NoCornerReason> Adjacent::find(std::span<const LineSegment> lines, std::size_t first,
                                             std::size_t second, Corner& corner) const {
  const LineSegment& a = lines[first];
  const LineSegment& b = lines[second];
  const Eigen::Vector2d normal_a(normals_.x[first], normals_.y[first]);
  const Eigen::Vector2d normal_b(normals_.x[second], normals_.y[second]);
  const double cross = normal_a.x() * normal_b.y() - normal_a.y() * normal_b.x();
  if (!(std::abs(cross) >= sine_of_min_angle_)) return NoCornerReason::small_angle;
  const auto estimate = intersect(a.estimate, normal_a, b.estimate, normal_b);
  if (!estimate) return NoCornerReason::small_angle;

  corner.gap = (b.start - a.end).norm();
  corner.extrapolation =
      std::max((estimate->position - a.end).norm(), (estimate->position - b.start).norm());
  const double step = std::min(ray_steps_[first], ray_steps_[second]);
  const double behind_first = small_angle_to(a.end, estimate->position);
  const double before_second = small_angle_to(estimate->position, b.start);
  // A wall that is seen beyond the corner does not end there: it passes behind the other one.
  const double inside = inside_steps * step + inside_deviations * bearing_stddev(*estimate);
  if (std::min(behind_first, before_second) < -inside) return NoCornerReason::inside_line;
  const double reach = steps_to_corner * step;
  corner.seen = std::abs(behind_first) <= reach && std::abs(before_second) <= reach;
  if (!corner.seen) {
    if (!(corner.gap <= parameters_.max_gap)) return NoCornerReason::wide_gap;
    if (!(corner.extrapolation <= parameters_.max_extrapolation)) return NoCornerReason::far_away;
  }
  corner.estimate = *estimate;
  corner.angle = angle_between(a.estimate.line.alpha, b.estimate.line.alpha);
  corner.opening = opening_of(estimate->position, a, b);
  corner.first_line = first;
  corner.second_line = second;
  return std::nullopt;
}

void Adjacent::operator()(std::span<const LineSegment> lines, double range_bias_stddev,
                          FoundCorners& found) {
  found.corners.clear();
  found.without.clear();
  const std::size_t count = lines.size();
  if (count < 2) return;
  normals_.resize(count);
  // All sines and cosines at once, as of points at unit distance.
  for (std::size_t i = 0; i < count; ++i) {
    normals_.range[i] = 1.0;
    normals_.bearing[i] = lines[i].estimate.line.alpha;
  }
  compute_cartesian(normals_);
  ray_steps_.clear();
  for (const LineSegment& line : lines) ray_steps_.push_back(ray_step(line));

  Corner corner;
  for (std::size_t first = 0; first < count; ++first) {
    const std::size_t second = first + 1 < count ? first + 1 : 0;
    // Two lines meet once, although each of them is the other's neighbour on both sides.
    if (count == 2 && !found.corners.empty()) break;
    if (const auto reason = find(lines, first, second, corner)) {
      found.without.push_back({first, second, *reason});
      continue;
    }
    found.corners.push_back(corner);
    if (parameters_.include_range_bias && range_bias_stddev > 0.0) {
      found.corners.back().estimate = with_range_bias(corner.estimate, range_bias_stddev);
    }
  }
}

}  // namespace quoin
