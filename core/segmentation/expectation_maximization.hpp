// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <limits>
#include <span>
#include <tuple>
#include <vector>

#include "core/segmentation/runs.hpp"
#include "core/segmentation/segment_builder.hpp"

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
    Moments moments;
    OrthogonalLine fit;
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

/// Expectation maximisation (Liu et al. 2001): a mixture of lines and a uniform background is
/// fitted to the points of each cluster, starting from lines through evenly spread windows. In
/// turns, each point belongs to the lines by their densities at it, and each line is the total
/// least squares line of its points by these weights. Runs of points that most probably are of one
/// line are its segments. The start leaves nothing to chance, so there is no seed.
class ExpectationMaximization {
 public:
  static constexpr const char* name = "expectation_maximization";
  static constexpr const char* description =
      "expectation maximisation: fits a mixture of lines and a background to each cluster";
  static constexpr const char* source = "Liu et al. 2001; Nguyen et al. 2007";
  static constexpr const char* choose =
      "At 50 mm when finding the walls is worth any time: there it finds most. It is the slowest, "
      "and makes hardly fewer errors than iepf.";

  struct Parameters : SegmentationParameters {
    int window = 8;
    int lines = 120;
    int iterations = 10;

    static constexpr auto fields() {
      using P = Parameters;
      return std::tuple_cat(
          std::make_tuple(
              field<P, int>(&P::window, "window", "", 3, 1000, "points each line starts from"),
              field<P, int>(&P::lines, "lines", "", 1, 1000,
                            "most lines of a cluster; the windows grow accordingly"),
              field<P, int>(&P::iterations, "iterations", "", 1, 1000,
                            "steps of expectation and maximisation")),
          common_fields<P>());
    }
  };

  ExpectationMaximization() : ExpectationMaximization(Parameters{}) {}
  explicit ExpectationMaximization(const Parameters& parameters);

  void operator()(const PointsView& scan, const SensorModel& sensor, Segmentation& found);

 private:
  void add_runs(const PointsView& points, const Segment& cluster);

  Parameters parameters_;
  std::size_t fewest_;  // points of a line
  SegmentBuilder builder_;
  PrefixMoments moments_;
  LineMixture mixture_;
  std::vector<std::size_t> labels_;  // the line of each point of the cluster
};

}  // namespace quoin
