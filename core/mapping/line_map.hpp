// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <type_traits>
#include <unordered_map>
#include <vector>

#include <Eigen/Core>

namespace quoin {

/// A straight wall of a map.
struct MapLine {
  std::uint64_t id = 0;                             ///< unique in its map, never used again
  Eigen::Vector2d start = Eigen::Vector2d::Zero();  ///< [m] in the frame of the map
  Eigen::Vector2d end = Eigen::Vector2d::Zero();    ///< [m]; seen from where it was seen, from
                                                    ///< start to end is counter-clockwise
  /// Of (direction [rad], offset across the line at its middle [m]), 2x2; zero where the method
  /// does not know it.
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();
  std::size_t observations = 0;  ///< how often it was seen

  [[nodiscard]] Eigen::Vector2d middle() const { return 0.5 * (start + end); }
  [[nodiscard]] double length() const { return (end - start).norm(); }
  [[nodiscard]] double direction() const;  ///< [rad] from start to end

  template <class Archive, class Self>
  static void transfer(Archive& archive, Self& self) {
    archive(self.id, self.start, self.end, self.covariance, self.observations);
  }
};

/// The stored line that a new one continues.
struct LineMatch {
  std::size_t index = 0;      ///< in LineMap::lines
  double distance = 0.0;      ///< [m] of origin distances and of centroids, summed
  double angle_offset = 0.0;  ///< [rad] stored less new direction, in (-pi/2, pi/2]
};

/// A map of segments that grows by the rule of Opromolla et al. 2017, section 2.1: two segments are
/// of one wall when their directions differ by less than an angle, and the difference of their
/// distances from the origin plus the distance of their centroids is less than a distance. The same
/// segments in the same order give the same map.
///
/// Centroids are found by a grid of cells as wide as that distance, so that the time of a look-up
/// does not grow with the map.
class LineMap {
 public:
  /// Largest difference of directions [rad] and largest distance [m] of a match.
  LineMap(double largest_angle, double largest_distance);

  /// The stored line nearest to the segment of all that match it.
  [[nodiscard]] std::optional<LineMatch> find(const Eigen::Vector2d& start,
                                              const Eigen::Vector2d& end) const;

  /// Stores a new line; returns its index.
  std::size_t add(const Eigen::Vector2d& start, const Eigen::Vector2d& end);

  /// The same with a line as it is; its id becomes the index.
  std::size_t add(const MapLine& line);

  /// Lengthens a stored line, whose direction stays, to the projections of these ends.
  void extend(std::size_t index, const Eigen::Vector2d& start, const Eigen::Vector2d& end);

  /// Extends the line that matches, or stores a new one; returns its index.
  std::size_t merge(const Eigen::Vector2d& start, const Eigen::Vector2d& end);

  [[nodiscard]] std::span<const MapLine> lines() const { return lines_; }
  void clear();

  template <class Archive, class Self>
  static void transfer(Archive& archive, Self& self) {
    archive(self.lines_);
    if constexpr (!std::is_const_v<Self>) self.restore_cells();
  }

 private:
  void restore_cells();
  using Cell = std::uint64_t;
  [[nodiscard]] Cell cell_of(const Eigen::Vector2d& point, int right = 0, int up = 0) const;

  double largest_angle_;
  double largest_distance_;
  std::vector<MapLine> lines_;
  std::unordered_map<Cell, std::vector<std::size_t>> cells_;  // lines by their centroids
};

}  // namespace quoin
