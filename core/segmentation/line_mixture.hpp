// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include "core/segmentation/moment_sums.hpp"
#include "core/segmentation/segment.hpp"
#include "core/segmentation/tolerance.hpp"
#include "core/sensor/points.hpp"

namespace quoin {

/// Mixture of lines and a background that explains the points of a cluster. A line has the density
/// of noise across it, a quarter of the tolerance being its standard deviation, and a normal
/// distribution along it, so that it is where its points are; the background is uniform over the
/// surroundings of the cluster. Keeps its memory.
class LineMixture {
 public:
  static constexpr std::size_t background = std::numeric_limits<std::size_t>::max();

  /// Starts from the straight ones among equal windows of the cluster.
  void start(const PointsView& points, const Segment& cluster, const PrefixMoments& moments,
             const Tolerance& tolerance, std::size_t window);

  /// One step of expectation and maximisation. Lines with less than `fewest` points are dropped and
  /// neighbours that one line explains as well are joined.
  void step(const PointsView& points, const Tolerance& tolerance, double fewest);

  /// The most probable line of each point of the cluster, `background` where a point is beyond its
  /// tolerance from that.
  void label(const PointsView& points, const Tolerance& tolerance,
             std::vector<std::size_t>& labels);

  [[nodiscard]] std::size_t lines() const { return components_.size(); }
  [[nodiscard]] const NormalLine& line(std::size_t k) const { return components_[k].fit.line; }

 private:
  struct Component {
    MomentSums moments;
    OrthogonalFit fit;
    double probability = 0.0;
  };

  /// Fills the densities of a component at each point, times its probability.
  void compute_density(const PointsView& points, const Tolerance& tolerance,
                       const Component& component, std::span<double> density) const;
  void compute_densities(const PointsView& points, const Tolerance& tolerance);
  void join(const Tolerance& tolerance);
  [[nodiscard]] std::span<double> density_of(std::size_t k);

  Segment cluster_;
  std::vector<Component> components_;  // in the order of the scan
  double background_density_ = 0.0;    // [1/m^2] of one point
  double background_probability_ = 0.0;
  std::vector<double> densities_;  // [1/m^2] of one component after the other
  std::vector<double> totals_;     // [1/m^2] of each point
};

}  // namespace quoin
