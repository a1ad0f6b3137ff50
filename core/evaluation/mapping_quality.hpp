// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "core/extraction/extraction.hpp"
#include "core/mapping/localizer.hpp"
#include "core/mapping/motion.hpp"
#include "core/simulation/world.hpp"

namespace quoin {

/// A drive through a simulated world with a LiDAR and wheels.
struct SimulatedDrive {
  double speed = 0.5;            ///< [m/s] along the world's path, there and back again
  double laps = 10.0;            ///< there and back is one
  double period = 0.1;           ///< [s] between scans
  std::size_t rays = 720;        ///< of a revolution
  double range_max = 40.0;       ///< [m]
  SensorModel noise;             ///< of the LiDAR
  bool odometry = true;          ///< whether the localizer gets it
  double slip = 0.02;            ///< the wheels count so much more than was driven
  double heading_bias = 0.0;     ///< [rad/m]
  OdometryNoise odometry_noise;  ///< of each increment, and what the localizer is told
  std::uint64_t seed = 1;
};

/// How a localizer did against the truth.
struct MappingQuality {
  std::size_t scans = 0;
  std::vector<double> translation_errors;  ///< [m] of each scan
  std::vector<double> heading_errors;      ///< [rad], not negative
  std::vector<double> nees;  ///< of the scans that were tracked: 3 on average when it is true
  std::size_t tracking = 0, ambiguous = 0, lost = 0;
  /// Scans while tracking whose error is beyond the four sigma of a Gaussian of 3 dimensions.
  std::size_t confident_wrong = 0;
  /// Share of the length of mapped lines that lies on a wall (within 5 cm and 3 deg), and of the
  /// length of the walls that some mapped line lies on.
  double map_precision = 0.0, map_recall = 0.0;
  std::size_t map_lines = 0;

  [[nodiscard]] double mean_nees() const;
  [[nodiscard]] double coverage95() const;  ///< share of nees below the 95 % of chi square of 3
};

/// A localizer, or what stands for one.
using Localize = std::function<void(const LocalizationInput&, Localization&)>;

/// Drives and judges. The first pose is the origin of the localizer's map.
[[nodiscard]] MappingQuality judge_localizer(const Localize& localizer, Extraction& extraction,
                                             const World& world, const SimulatedDrive& drive);

/// A verified relative pose between two instants, as of Kuemmerle et al. 2009.
struct PoseRelation {
  double first = 0.0;   ///< [s]
  double second = 0.0;  ///< [s]
  Pose2 relative;       ///< of the second in the frame of the first
};

struct StampedPose {
  double stamp = 0.0;  ///< [s]
  Pose2 pose;
};

/// Errors of a trajectory by relations (Kuemmerle et al. 2009, "On measuring the accuracy of SLAM
/// algorithms"): of each relation, the length of the translation and the absolute rotation by which
/// the relative pose of the trajectory differs.
struct RelationErrors {
  std::vector<double> translation;  ///< [m]
  std::vector<double> rotation;     ///< [rad]
  std::size_t skipped = 0;          ///< relations whose instants the trajectory does not have
};

/// Poses are taken at the nearest stamp within `largest_gap` [s]; with `interpolate`, between the
/// poses around the instant when they are no farther apart than that. Stamps ascend.
[[nodiscard]] RelationErrors relation_errors(std::span<const StampedPose> trajectory,
                                             std::span<const PoseRelation> relations,
                                             double largest_gap, bool interpolate);

}  // namespace quoin
