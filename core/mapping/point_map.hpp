// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>
#include <vector>

#include <Eigen/Core>

#include "core/geometry/pose.hpp"
#include "core/mapping/motion.hpp"

namespace quoin {

/// A point on a surface, with the unit normal towards the side it is seen from; zero where the
/// surface has no direction, such as on a leg of a chair.
struct SurfacePoint {
  Eigen::Vector2f position = Eigen::Vector2f::Zero();  ///< [m]
  Eigen::Vector2f normal = Eigen::Vector2f::Zero();

  template <class Archive, class Self>
  static void transfer(Archive& archive, Self& self) {
    archive(self.position, self.normal);
  }
};

/// Points of a scan [m, frame of the sensor, in order of bearing] nearer than `reach`, thinned to
/// about `spacing` [m]. The result is cleared first and keeps its memory.
void surface_points(std::span<const Eigen::Vector2d> points, double spacing, double reach,
                    std::vector<SurfacePoint>& result);

/// The same points from another pose.
[[nodiscard]] SurfacePoint transformed(const Pose2& pose, const SurfacePoint& point);

/// Where a scan lies best on a PointMap.
struct Registration {
  PoseEstimate estimate;  ///< covariance by the points alone
  double share = 0.0;     ///< of the points that lie on points of the map
};

/// Where a pose is looked for: a box around its centre.
struct PoseWindow {
  Pose2 center;
  double translation = 0.5;  ///< [m] to either side, in x and y
  double turn = 0.3;         ///< [rad] to either side
};

/// Points of some scans around a place, to find the pose of another scan.
///
/// A grid of 5 cm holds for each cell its nearest point within 0.3 m and a likelihood
/// exp(-d^2 / (2 0.1^2)) of its distance d. `search` sums likelihoods of the points of a scan over
/// all poses of a window, block by block with the largest likelihood of each block as a bound, in a
/// large window in blocks of blocks (Olson 2009, Hess et al. 2016). `refine` is iterated least
/// squares on
///
///     sum_i w(r_i) r_i^2,   r_i = n_i . (T p_i - q_i),   w(r) = 1 / (1 + (r / 0.05 m)^2)^2
///
/// with q_i the nearest point of the map and n_i its normal (Censi 2008; Geman and McClure 1985).
class PointMap {
 public:
  struct Candidate {
    Pose2 pose;
    double score = 0.0;  ///< mean likelihood of the points, 0 to 1
  };

  /// Empty, for points within a square of `reach` [m] to each side of `center` [m].
  void clear(const Eigen::Vector2d& center, double reach);
  /// Adds points of a scan from its pose. What lies within 3 cm of what is there adds nothing.
  void add(const Pose2& pose, std::span<const SurfacePoint> points);

  [[nodiscard]] const Eigen::Vector2d& center() const { return center_; }
  [[nodiscard]] bool empty() const { return points_.empty(); }

  /// The best poses, the best first, at most `count`, apart by more than 0.3 m or 0.15 rad. All
  /// that score more than 0.8 of the best one are found.
  [[nodiscard]] std::vector<Candidate> search(std::span<const SurfacePoint> scan,
                                              const PoseWindow& window, std::size_t count);
  /// From a pose near the right one; `prior` decides where the points leave a direction open.
  [[nodiscard]] Registration refine(std::span<const SurfacePoint> scan, const Pose2& start,
                                    const PoseEstimate& prior) const;
  /// Share of points of the scan that lie on points of the map.
  [[nodiscard]] double share(std::span<const SurfacePoint> scan, const Pose2& pose) const;

  template <class Archive, class Self>
  static void transfer(Archive& archive, Self& self) {
    archive(self.center_, self.side_, self.points_);
    if constexpr (!std::is_const_v<Self>) self.restore_cells();
  }

 private:
  void restore_cells();
  void mark(std::size_t point_index);
  [[nodiscard]] const SurfacePoint* nearest(const Eigen::Vector2d& point) const;
  void pool(std::size_t level);

  Eigen::Vector2d center_ = Eigen::Vector2d::Zero();
  Eigen::Vector2d corner_ = Eigen::Vector2d::Zero();  // of cell 0
  int side_ = 0;                                      // cells
  std::vector<SurfacePoint> points_;
  std::vector<std::int32_t> nearest_;     // index in points_, -1 where none is near
  std::vector<std::uint8_t> likelihood_;  // of 255
  // Largest of the block of cells from this one on, for blocks of two sizes; empty until needed.
  std::array<std::vector<std::uint8_t>, 2> pooled_;
};

}  // namespace quoin
