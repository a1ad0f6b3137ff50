// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
//
// Lines and corners of one scan. A real program takes ranges and bearings from its LiDAR; here they
// are those of a room of 4 m by 3 m, seen from its middle.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <numbers>
#include <vector>

#include "core/extraction/feature_extractor.hpp"

namespace {

void print(const quoin::Features& found) {
  for (const quoin::LineSegment& wall : found.lines) {
    std::printf("wall   %.3f m away, %3zu points, from (%.3f, %.3f) to (%.3f, %.3f)\n",
                wall.estimate.line.r, wall.points, wall.start.x(), wall.start.y(), wall.end.x(),
                wall.end.y());
  }
  for (const quoin::Corner& corner : found.corners) {
    const Eigen::Vector2d& position = corner.estimate.position;
    const Eigen::Matrix2d& covariance = corner.estimate.covariance;
    std::printf("corner (%.3f, %.3f) m, standard deviations %.1f mm and %.1f mm\n", position.x(),
                position.y(), 1e3 * std::sqrt(covariance(0, 0)), 1e3 * std::sqrt(covariance(1, 1)));
  }
}

int run() {
  std::vector<float> bearings;  // [rad] counter-clockwise from x
  std::vector<float> ranges;    // [m]
  for (int i = 0; i < 720; ++i) {
    const double bearing = 2.0 * std::numbers::pi * i / 720;
    bearings.push_back(static_cast<float>(bearing));
    ranges.push_back(static_cast<float>(
        std::min(2.0 / std::abs(std::cos(bearing)), 1.5 / std::abs(std::sin(bearing)))));
  }
  // What the sensor's ranges [m] and bearings [rad] scatter by; `quoin calibrate` measures it.
  quoin::FeatureExtractor extract({.range_stddev = 0.010, .bearing_stddev = 0.002});
  print(extract({.bearings = bearings, .ranges = ranges}));
  return 0;
}

}  // namespace

int main() {
  try {
    return run();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "corners: %s\n", error.what());
    return 1;
  }
}
