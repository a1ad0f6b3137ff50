// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/corners/adjacent.hpp"

#include <algorithm>
#include <cmath>

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

}  // namespace

Adjacent::Adjacent(const Parameters& parameters)
    : parameters_(parameters), sine_of_min_angle_(std::sin(parameters.min_angle)) {}

bool Adjacent::find(std::span<const LineSegment> lines, std::size_t first, std::size_t second,
                    Corner& corner) {
  const LineSegment& a = lines[first];
  const LineSegment& b = lines[second];
  corner.gap = std::sqrt((b.start - a.end).squaredNorm());
  if (!(corner.gap <= parameters_.max_gap)) return false;
  const Eigen::Vector2d normal_a(normals_.x[first], normals_.y[first]);
  const Eigen::Vector2d normal_b(normals_.x[second], normals_.y[second]);
  const double cross = normal_a.x() * normal_b.y() - normal_a.y() * normal_b.x();
  if (!(std::abs(cross) >= sine_of_min_angle_)) return false;
  const auto estimate = intersect(a.estimate, normal_a, b.estimate, normal_b);
  if (!estimate) return false;
  corner.extrapolation = std::sqrt(std::max((estimate->position - a.end).squaredNorm(),
                                            (estimate->position - b.start).squaredNorm()));
  if (!(corner.extrapolation <= parameters_.max_extrapolation)) return false;
  corner.estimate = *estimate;
  corner.angle = angle_between(a.estimate.line.alpha, b.estimate.line.alpha);
  corner.first_line = first;
  corner.second_line = second;
  return true;
}

void Adjacent::operator()(std::span<const LineSegment> lines, double range_bias_stddev,
                          std::vector<Corner>& corners) {
  corners.clear();
  const std::size_t count = lines.size();
  if (count < 2) return;
  normals_.resize(count);
  // All sines and cosines at once, as of points at unit distance.
  for (std::size_t i = 0; i < count; ++i) {
    normals_.range[i] = 1.0;
    normals_.bearing[i] = lines[i].estimate.line.alpha;
  }
  compute_cartesian(normals_);

  Corner corner;
  for (std::size_t first = 0; first < count; ++first) {
    const std::size_t second = first + 1 < count ? first + 1 : 0;
    if (!find(lines, first, second, corner)) continue;
    // Two lines meet once, although each of them is the other's neighbour on both sides.
    if (count == 2 && !corners.empty()) continue;
    corners.push_back(corner);
    if (parameters_.include_range_bias && range_bias_stddev > 0.0) {
      corners.back().estimate = with_range_bias(corner.estimate, range_bias_stddev);
    }
  }
}

}  // namespace quoin
