// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/circles/circle_fit.hpp"

namespace quoin {

/// From the circle of Taubin by Fisher's scoring to the one that is most likely under the noise of
/// range and bearing of each ray: the root of the sum of g d / v (see CircleSums). What is left of
/// bias, which comes from the circle's own curvature and is of second order in the noise (Box
/// 1971), is taken off at the end. The covariance is the inverse of Fisher's information, and that
/// of a range bias.
class MaximumLikelihoodCircle {
 public:
  static constexpr const char* name = "maximum_likelihood";
  static constexpr const char* description =
      "iterated fit on the noise model of each ray, less its bias; reaches the Cramer-Rao bound";
  static constexpr const char* source =
      "Fisher scoring on the noise model of ranges and bearings; bias by Box 1971";
  static constexpr const char* choose =
      "For nearly everything: columns, poles and round rooms, with a covariance that holds as long "
      "as the noise is less than about a tenth of the radius. The noise model must be right, for "
      "it takes its weights from it.";

  using Parameters = CircleParameters;

  MaximumLikelihoodCircle() = default;
  explicit MaximumLikelihoodCircle(const Parameters& parameters) : parameters_(parameters) {}

  CircleFit operator()(const PointsView& points, const SensorModel& sensor) const;

 private:
  Parameters parameters_;
};

}  // namespace quoin
