// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/circles/circle.hpp"
#include "core/circles/circle_fit.hpp"

namespace quoin {

/// The algebraic circle, less the bias that noise along the circle and along the rays gives it to
/// second order, with the covariance that the noise of each ray gives it, to first order that of
/// the circle with the least squared distances: its points have one weight.
[[nodiscard]] CircleFit fit_algebraic(const PointsView& points, const SensorModel& sensor,
                                      CircleConstraint constraint,
                                      const CircleParameters& parameters);

/// What the three have in common.
template <CircleConstraint constraint>
class AlgebraicCircle {
 public:
  using Parameters = CircleParameters;

  AlgebraicCircle() = default;
  explicit AlgebraicCircle(const Parameters& parameters) : parameters_(parameters) {}

  CircleFit operator()(const PointsView& points, const SensorModel& sensor) const {
    return fit_algebraic(points, sensor, constraint, parameters_);
  }

 private:
  Parameters parameters_;
};

class TaubinCircle : public AlgebraicCircle<CircleConstraint::taubin> {
 public:
  using AlgebraicCircle::AlgebraicCircle;

  static constexpr const char* name = "taubin";
  static constexpr const char* description =
      "algebraic circle, squares over the mean squared gradient, less its bias; no iteration";
  static constexpr const char* source = "Taubin 1991";
  static constexpr const char* choose =
      "Where a noise model is not to be relied on for weights. All points count alike, so that it "
      "is less accurate than maximum_likelihood where the incidence varies, as on a whole column.";
};

class PrattCircle : public AlgebraicCircle<CircleConstraint::pratt> {
 public:
  using AlgebraicCircle::AlgebraicCircle;

  static constexpr const char* name = "pratt";
  static constexpr const char* description =
      "algebraic circle, squares over the squared radius, less its bias";
  static constexpr const char* source = "Pratt 1987";
  static constexpr const char* choose =
      "To compare with taubin: the same to first order, with twice the bias to take off.";
};

class HyperCircle : public AlgebraicCircle<CircleConstraint::hyper> {
 public:
  using AlgebraicCircle::AlgebraicCircle;

  static constexpr const char* name = "hyper";
  static constexpr const char* description =
      "algebraic circle that noise alike in all directions does not bias";
  static constexpr const char* source = "Al-Sharadqah and Chernov 2009";
  static constexpr const char* choose =
      "Where taubin would do and the noise of range and bearing are about as large: then there is "
      "no bias to take off.";
};

}  // namespace quoin
