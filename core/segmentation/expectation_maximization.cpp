// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/segmentation/expectation_maximization.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace quoin {
namespace {

constexpr double variances_in_tolerance = deviations_in_tolerance * deviations_in_tolerance;
constexpr double farthest_along = 16.0;    // squared, in variances along the line
constexpr double least_background = 0.01;  // probability
// Squared Mahalanobis distance of two lines that are the same with a probability of 0.25 %.
constexpr double largest_difference = 12.0;
// Points times lines: clusters that have more are given fewer steps, so that no scan takes for
// ever.
constexpr double most_densities = 2.5e6;

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
    component.fit = orthogonal_line(component.moments);
    if (!component.fit.ok() ||
        farthest_from(component.fit.line, points.subview(begin, end), tolerance).beyond()) {
      continue;
    }
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
  const OrthogonalLine& fit = component.fit;
  const NormalLine& line = fit.line;
  const double inverse_along = 1.0 / std::max(fit.along / fit.moments.weight, 1e-12);
  const double scale =
      component.probability * std::sqrt(inverse_along) * 0.5 * std::numbers::inv_pi;
  for (std::size_t k = 0; k < density.size(); ++k) {
    const std::size_t i = cluster_.begin + k;
    density[k] = 0.0;
    const double along =
        line.along(points.x[i] - fit.moments.mean_x, points.y[i] - fit.moments.mean_y);
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
    const auto distance = squared_mahalanobis(first.moments, second.moments, tolerance);
    if (distance && *distance <= largest_difference) {
      first.moments += second.moments;
      first.probability += second.probability;
      first.fit = orthogonal_line(first.moments);
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
    component.fit = orthogonal_line(component.moments);
    if (!component.fit.ok()) continue;
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

ExpectationMaximization::ExpectationMaximization(const Parameters& parameters)
    : parameters_(parameters),
      fewest_(static_cast<std::size_t>(std::max(parameters.min_points, 3))),
      builder_(parameters) {}

void ExpectationMaximization::add_runs(const PointsView& points, const Segment& cluster) {
  for (std::size_t i = 0; i < labels_.size();) {
    const std::size_t label = labels_[i];
    std::size_t end = i + 1;
    if (label != LineMixture::background) {
      // Passes over few points that seem to be of another line but are near this one as well.
      for (std::size_t k = end; k < labels_.size() && k <= end + largest_gap_in_run; ++k) {
        if (labels_[k] == label) {
          end = k + 1;
        } else if (excess_of(mixture_.line(label), points, cluster.begin + k,
                             builder_.tolerance()) > largest_outlier) {
          break;
        }
      }
      if (end - i >= fewest_) builder_.add({cluster.begin + i, cluster.begin + end});
    }
    i = end;
  }
}

void ExpectationMaximization::operator()(const PointsView& scan, const SensorModel& sensor,
                                         Segmentation& found) {
  const PointsView points = builder_.start(scan, sensor);
  moments_.assign(points);
  for (const Segment& cluster : builder_.clusters()) {
    if (cluster.size() < fewest_) continue;
    const std::size_t window =
        std::max(static_cast<std::size_t>(parameters_.window),
                 cluster.size() / static_cast<std::size_t>(parameters_.lines) + 1);
    mixture_.start(points, cluster, moments_, builder_.tolerance(), window);
    const double densities = static_cast<double>(cluster.size() * mixture_.lines());
    const double part = std::min(1.0, most_densities / std::max(densities, 1.0));
    const int iterations = static_cast<int>(std::ceil(part * parameters_.iterations));
    if (part < 1.0) builder_.cut_short();
    for (int k = 0; k < iterations; ++k) {
      mixture_.step(points, builder_.tolerance(), static_cast<double>(fewest_) / 2.0);
    }
    mixture_.label(points, builder_.tolerance(), labels_);
    add_runs(points, cluster);
  }
  builder_.finish(found);
}

}  // namespace quoin
