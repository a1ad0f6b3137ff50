// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>

#include "core/extraction/extraction.hpp"
#include "core/extraction/method_chain.hpp"

namespace quoin {

/// What is in one scan, in the frame of the sensor: x at bearing 0, y at bearing pi/2. Views of the
/// extractor's own storage, valid until its next call.
struct Features {
  /// The N valid points of the scan, counter-clockwise from a break between surfaces on, not from
  /// the first ray; behind them those that stand in front of a wall.
  PointsView points;
  /// Straight walls: ranges [begin, end) of `points`, ascending and disjoint.
  std::span<const Segment> segments;
  /// Round surfaces, the same way.
  std::span<const Segment> arcs;
  /// L lines in scanning order, each with its 2x2 covariance [rad^2, rad m; rad m, m^2] about the
  /// mid-point of the wall and the ends of the wall [m].
  std::span<const LineSegment> lines;
  /// The segment of each of the L lines.
  std::span<const Segment> fitted;
  /// Why the other segments have no line.
  std::span<const FitFailure> failures;
  /// Corners with their positions [m], 2x2 covariances [m^2] and the indices of their two lines.
  std::span<const Corner> corners;
};

/// From ranges and bearings to segments, lines and corners with covariances: what the services
/// segmentation, line_fitting and corner_estimation do one after the other, in one call.
///
///   quoin::FeatureExtractor extract({.range_stddev = 0.01, .bearing_stddev = 0.002});
///   const quoin::Features found = extract({.bearings = bearings, .ranges = ranges});
///   for (const quoin::Corner& corner : found.corners) use(corner.estimate.position);
///
/// One extractor for each thread. Once it has seen scans of the size and of the richness that
/// follow, a call with the default methods allocates nothing.
class FeatureExtractor {
 public:
  /// `sensor` is the noise of the ranges [m] and bearings [rad], from which the covariances come;
  /// `quoin calibrate` measures it. Throws ParameterError when a figure of the sensor, a method or
  /// one of its settings cannot be used, std::logic_error when this program and the library were
  /// compiled with matrices of different alignment (-march).
  explicit FeatureExtractor(const SensorModel& sensor = {}, const MethodChain& methods = {})
      : FeatureExtractor(sensor, methods, alignof(LineSegment)) {}

  /// The features of one revolution or sweep: M bearings [rad] and M ranges [m], in either
  /// direction, starting anywhere. Ranges that are NaN, infinite, not positive or outside of the
  /// limits of the scan are no points; where the two spans differ in length, what both have is
  /// used. A scan without a wall has no features, which is no error. Throws nothing but
  /// std::bad_alloc.
  [[nodiscard]] Features operator()(const ScanView& scan);

 private:
  FeatureExtractor(const SensorModel& sensor, const MethodChain& methods,
                   std::size_t alignment_of_lines);

  SensorModel sensor_;
  Extraction extraction_;
};

}  // namespace quoin
