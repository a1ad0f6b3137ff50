// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/segmentation/line_mixture.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/segmentation/runs.hpp"

namespace quoin {
namespace {

constexpr double variances_in_tolerance = deviations_in_tolerance * deviations_in_tolerance;
constexpr double farthest_along = 16.0;    // squared, in variances along the line
constexpr double least_background = 0.01;  // probability
// Squared Mahalanobis distance of two lines that are the same with a probability of 0.25 %.
constexpr double largest_difference = 12.0;

}  // namespace

std::span<double> LineMixture::density_of(std::size_t k) {
  return std::span(densities_).subspan(k * cluster_.size(), cluster_.size());
}

void LineMixture::start(const PointsView& points, const Segment& cluster,
                        const PrefixMoments& moments, const Tolerance& tolerance,
                        std::size_t window) {
  cluster_ = cluster;
  components_.clear();
  const std::size_t count = (cluster.size() + window - 1) / window;
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t begin = cluster.begin + cluster.size() * k / count;
    const std::size_t end = cluster.begin + cluster.size() * (k + 1) / count;
    Component component;
    component.moments = moments(begin, end);
    const auto fit = orthogonal_fit(component.moments);
    if (!fit || farthest_from(fit->line, points.subview(begin, end), tolerance).beyond()) {
      continue;
    }
    component.fit = *fit;
    component.probability = 1.0 / static_cast<double>(count + 1);
    components_.push_back(component);
  }
  const PointsView view = points.subview(cluster.begin, cluster.end);
  const auto [left, right] = std::minmax_element(view.x.begin(), view.x.end());
  const auto [bottom, top] = std::minmax_element(view.y.begin(), view.y.end());
  const double margin = std::sqrt(tolerance.largest);
  background_density_ = 1.0 / ((*right - *left + margin) * (*top - *bottom + margin));
  background_probability_ = 1.0 / static_cast<double>(count + 1);
}

void LineMixture::compute_density(const PointsView& points, const Tolerance& tolerance,
                                  const Component& component, std::span<double> density) const {
  const OrthogonalFit& fit = component.fit;
  const NormalLine& line = fit.line;
  const double inverse_along = 1.0 / std::max(fit.along, 1e-12);
  const double scale =
      component.probability * std::sqrt(inverse_along) * 0.5 * std::numbers::inv_pi;
  for (std::size_t k = 0; k < density.size(); ++k) {
    const std::size_t i = cluster_.begin + k;
    density[k] = 0.0;
    const double along =
        line.normal_y * (points.x[i] - fit.x) - line.normal_x * (points.y[i] - fit.y);
    const double exponent_along = along * along * inverse_along;
    if (exponent_along > farthest_along) continue;
    const double across = line.distance(points.x[i], points.y[i]);
    const double squared = tolerance.squared(points, i, line.normal_x, line.normal_y);
    if (across * across > largest_outlier * squared) continue;
    const double inverse = variances_in_tolerance / squared;
    density[k] =
        scale * std::sqrt(inverse) * std::exp(-0.5 * (exponent_along + across * across * inverse));
  }
}

void LineMixture::compute_densities(const PointsView& points, const Tolerance& tolerance) {
  const std::size_t count = cluster_.size();
  densities_.resize(components_.size() * count);
  totals_.assign(count, background_probability_ * background_density_);
  for (std::size_t k = 0; k < components_.size(); ++k) {
    const std::span<double> density = density_of(k);
    compute_density(points, tolerance, components_[k], density);
    for (std::size_t i = 0; i < count; ++i) totals_[i] += density[i];
  }
}

void LineMixture::join(const Tolerance& tolerance) {
  if (components_.empty()) return;
  std::size_t kept = 0;
  for (std::size_t k = 1; k < components_.size(); ++k) {
    Component& first = components_[kept];
    const Component& second = components_[k];
    const auto joint = joint_fit(first.moments, second.moments, tolerance);
    if (joint && joint->distance <= largest_difference) {
      first.moments += second.moments;
      first.probability += second.probability;
      first.fit = joint->fit;
    } else {
      components_[++kept] = second;
    }
  }
  components_.resize(kept + 1);
}

void LineMixture::step(const PointsView& points, const Tolerance& tolerance, double fewest) {
  compute_densities(points, tolerance);
  const std::size_t count = cluster_.size();
  for (std::size_t i = 0; i < count; ++i) totals_[i] = 1.0 / totals_[i];
  double explained = 0.0;
  std::size_t kept = 0;
  for (std::size_t k = 0; k < components_.size(); ++k) {
    const std::span<const double> density = density_of(k);
    Component component;
    for (std::size_t i = 0; i < count; ++i) {
      if (density[i] == 0.0) continue;
      const std::size_t point = cluster_.begin + i;
      component.moments.add(points.x[point], points.y[point], density[i] * totals_[i]);
    }
    if (component.moments.weight < fewest) continue;
    const auto fit = orthogonal_fit(component.moments);
    if (!fit) continue;
    component.fit = *fit;
    component.probability = component.moments.weight / static_cast<double>(count);
    explained += component.probability;
    components_[kept++] = component;
  }
  components_.resize(kept);
  background_probability_ = std::max(least_background, 1.0 - explained);
  join(tolerance);
}

void LineMixture::label(const PointsView& points, const Tolerance& tolerance,
                        std::vector<std::size_t>& labels) {
  compute_densities(points, tolerance);
  labels.assign(cluster_.size(), background);
  for (std::size_t i = 0; i < cluster_.size(); ++i) {
    double largest = 0.0;
    for (std::size_t k = 0; k < components_.size(); ++k) {
      const double density = density_of(k)[i];
      if (density <= largest) continue;
      largest = density;
      labels[i] = k;
    }
    if (labels[i] == background) continue;
    if (excess_of(line(labels[i]), points, cluster_.begin + i, tolerance) > 1.0) {
      labels[i] = background;
    }
  }
}

}  // namespace quoin
