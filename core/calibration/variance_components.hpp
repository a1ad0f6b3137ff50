// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "core/sensor/points.hpp"

namespace quoin {

/// What makes the points of a wall leave its line, as scans show it.
struct NoiseComponents {
  double range_stddev = 0.0;            ///< [m] of each range, quantization included
  double range_stddev_per_metre = 0.0;  ///< without unit: what grows with the range
  double bearing_stddev = 0.0;          ///< [rad] what grows with range and incidence
  double flatness_stddev = 0.0;         ///< [m] shared by neighbouring rays, see SensorModel
  /// [m] between odd and even rays of one wall: sensors that sweep twice with half of the rays each
  /// show how they moved in between.
  double interlace_stddev = 0.0;
  /// Of the residuals of neighbouring rays; 0 for white noise.
  double neighbour_correlation = 0.0;

  /// As a sensor model; the bias of ranges does not show in the lines of walls and stays 0.
  [[nodiscard]] SensorModel model() const {
    return {range_stddev, bearing_stddev, 0.0, range_stddev_per_metre, flatness_stddev};
  }
};

/// What the variance of the distance of a point from its line is made of: the sum of these factors,
/// each times its own variance. phi is the angle of incidence, rho the range where the ray meets
/// the line, t the coordinate along the line from the foot of the perpendicular.
enum NoiseFactor : std::size_t {
  of_range,    ///< cos^2(phi), times range_stddev^2
  of_growth,   ///< (rho cos(phi))^2, times range_stddev_per_metre^2
  of_bearing,  ///< t^2, times bearing_stddev^2
  noise_factor_count,
};
using NoiseFactors = std::array<double, noise_factor_count>;

/// A few neighbouring points of a wall.
struct ResidualBlock {
  NoiseFactors factors{};  ///< means over the points
  double squared = 0.0;    ///< [m^2] sum of the squared distances from the wall's line
  double points = 0.0;
  double range = 0.0;   ///< [m] mean
  double cosine = 0.0;  ///< of the incidence angle, mean
};

/// Two lines of disjoint points of one wall.
struct HalvesDifference {
  Eigen::Vector2d difference;  ///< of (direction, offset) about the wall's middle [rad, m]
  Eigen::Matrix2d noise;       ///< its covariance by the noise of the rays
  Eigen::Matrix2d unevenness;  ///< what flatness_stddev^2 adds to it, for 1 m^2
};

/// A wall as it is seen about its own line.
struct WallResiduals {
  std::size_t first_block = 0, block_count = 0;
  double points = 0.0;
  double neighbours = 0.0;         ///< mean product of neighbouring residuals over the mean square
  double alternation = 0.0;        ///< [m] mean distance of odd rays less that of even ones
  double alternation_noise = 0.0;  ///< [m^2] its variance by white noise of the size seen
  std::optional<HalvesDifference> halves;  ///< of long walls
};

/// Walls of fewer points are too short to compare their halves.
inline constexpr std::size_t fewest_points_of_halves = 20;

/// Fits each wall under a sensor model and collects what is off the lines.
class ResidualTable {
 public:
  void clear();
  /// Leaves the wall out where there is no line.
  void add(const PointsView& points, const SensorModel& sensor);

  [[nodiscard]] std::span<const WallResiduals> walls() const { return walls_; }
  [[nodiscard]] std::span<const ResidualBlock> blocks(const WallResiduals& wall) const {
    return std::span(blocks_).subspan(wall.first_block, wall.block_count);
  }

 private:
  std::vector<WallResiduals> walls_;
  std::vector<ResidualBlock> blocks_;
  std::vector<double> residuals_;
};

/// The components that the residuals of these walls of the table show; `start` is where the
/// iteration begins. All zero without walls.
[[nodiscard]] NoiseComponents find_components(const ResidualTable& table,
                                              std::span<const WallResiduals> walls,
                                              const SensorModel& start);

/// Variance [m^2] of the distance from the line that the model gives the points of a block, that by
/// the flatness of walls included.
[[nodiscard]] double variance_of(const ResidualBlock& block, const SensorModel& model);

/// Sum over a wall of squared residuals over their variances.
[[nodiscard]] double chi_square(const ResidualTable& table, const WallResiduals& wall,
                                const SensorModel& model);

}  // namespace quoin
