// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/evaluation/segmentation_quality.hpp"

#include <algorithm>
#include <cmath>

#include "core/evaluation/scene.hpp"
#include "core/fitting/algebraic.hpp"
#include "core/geometry/angle.hpp"
#include "core/sensor/scan.hpp"
#include "core/simulation/scanner.hpp"

namespace quoin {
namespace {

/// A run of points on one wall.
struct TrueSegment {
  Segment segment;
  std::size_t wall = Hit::no_wall;
  Line line;
  double middle = 0.0;  // [m] along the line, of where its rays meet it
  bool required = false;
};

/// The wall of each of the points, which are the scan's valid rays in order from some ray on.
void label_points(const SimulatedScan& scan, const Points& points,
                  std::vector<std::size_t>& labels) {
  labels.clear();
  std::size_t first = 0;
  for (std::size_t i = 0; i < scan.ranges.size(); ++i) {
    if (!std::isfinite(scan.ranges[i])) continue;
    if (static_cast<double>(scan.bearings[i]) == points.bearing.front() &&
        static_cast<double>(scan.ranges[i]) == points.range.front()) {
      first = labels.size();
    }
    labels.push_back(scan.walls[i]);
  }
  labels.resize(points.size());
  std::rotate(labels.begin(), labels.begin() + static_cast<std::ptrdiff_t>(first), labels.end());
}

/// Distance [m] between where two rays meet the line.
double length_between(const Line& line, double bearing, double other_bearing) {
  return line.r * std::abs(std::tan(bearing - line.alpha) - std::tan(other_bearing - line.alpha));
}

void find_true_segments(const World& world, const Points& points,
                        const std::vector<std::size_t>& labels, const WorthFinding& worth,
                        std::vector<TrueSegment>& truth) {
  truth.clear();
  const Pose2& pose = world.path.front();
  for (std::size_t begin = 0; begin < labels.size();) {
    std::size_t end = begin + 1;
    while (end < labels.size() && labels[end] == labels[begin]) ++end;
    if (labels[begin] != Hit::no_wall) {
      const Line line = wall_line(world.walls[labels[begin]], pose);
      const double first = points.bearing[begin];
      const double last = points.bearing[end - 1];
      truth.push_back(
          {.segment = {begin, end},
           .wall = labels[begin],
           .line = line,
           .middle = 0.5 * line.r * (std::tan(first - line.alpha) + std::tan(last - line.alpha)),
           .required = end - begin >= worth.min_points &&
                       length_between(line, first, last) >= worth.min_length});
    }
    begin = end;
  }
}

std::size_t overlap(const Segment& a, const Segment& b) {
  const std::size_t begin = std::max(a.begin, b.begin);
  const std::size_t end = std::min(a.end, b.end);
  return begin < end ? end - begin : 0;
}

std::size_t points_on_wall(const std::vector<std::size_t>& labels, const Segment& segment,
                           std::size_t wall) {
  return static_cast<std::size_t>(
      std::count(labels.begin() + static_cast<std::ptrdiff_t>(segment.begin),
                 labels.begin() + static_cast<std::ptrdiff_t>(segment.end), wall));
}

/// How far a found line is from the true one.
struct LineError {
  double alpha;     // [rad]
  double r;         // [m]
  double distance;  // [m] at the middle of the true segment
};

LineError error_of(const Line& found, const TrueSegment& truth) {
  const Line& line = truth.line;
  // Near the sensor the normal may turn over.
  const bool turned = std::abs(normalized_angle(found.alpha - line.alpha)) > 0.5 * pi;
  const double alpha = normalized_angle(found.alpha - line.alpha + (turned ? pi : 0.0));
  const double r = (turned ? -found.r : found.r) - line.r;
  return {alpha, r, std::abs(r - truth.middle * std::sin(alpha))};
}

}  // namespace

SegmentationQuality judge_segmentation(const Segmenter& segmenter, std::span<const World> worlds,
                                       const SensorModel& noise, std::size_t scans_per_world,
                                       std::uint64_t seed, const WorthFinding& worth) {
  SegmentationQuality quality;
  std::size_t false_segments = 0;
  double alpha_squares = 0.0;
  double r_squares = 0.0;
  const Matching matching;
  const Wctls fitter;
  SimulatedScan scan;
  Points points;
  std::vector<std::size_t> labels;
  std::vector<TrueSegment> truth;
  Segmentation found;
  for (std::size_t w = 0; w < worlds.size(); ++w) {
    ScannerSettings settings;
    settings.noise = noise;
    SimulatedScanner scanner(worlds[w], settings, seed + w);
    for (std::size_t k = 0; k < scans_per_world; ++k) {
      scanner.scan(0.0, 0.0, scan);
      if (convert({scan.bearings, scan.ranges}, points) == 0) continue;
      label_points(scan, points, labels);
      find_true_segments(worlds[w], points, labels, worth, truth);
      segmenter(points, noise, found);
      const std::vector<Segment> in_scan = found.segments;
      set_aside(points, found);
      ++quality.scans;
      quality.found_segments += in_scan.size();
      for (const TrueSegment& segment : truth) quality.true_segments += segment.required ? 1 : 0;
      for (std::size_t i = 0; i < in_scan.size(); ++i) {
        const Segment& segment = in_scan[i];
        const Segment& own = found.segments[i];
        const FitResult fit = fitter(points.view().subview(own.begin, own.end), noise);
        bool matched = false;
        std::size_t small = 0;
        for (const TrueSegment& candidate : truth) {
          const std::size_t common = overlap(segment, candidate.segment);
          // More than half of the found points, and of those of this stretch of the wall.
          if (common == 0 || 2 * points_on_wall(labels, segment, candidate.wall) <= own.size()) {
            continue;
          }
          if (!candidate.required) small += common;
          if (!candidate.required || 2 * common <= candidate.segment.size() || !fit.ok()) continue;
          const LineError error = error_of(fit.estimate.line, candidate);
          if (std::abs(error.alpha) > matching.angle || error.distance > matching.distance) break;
          matched = true;
          ++quality.matches;
          alpha_squares += error.alpha * error.alpha;
          r_squares += error.r * error.r;
        }
        false_segments += matched || 2 * small > own.size() ? 0 : 1;
      }
    }
  }
  quality.true_positive_rate = proportion(quality.matches, quality.true_segments);
  quality.false_positive_rate = proportion(false_segments, quality.found_segments);
  if (quality.matches > 0) {
    const auto count = static_cast<double>(quality.matches);
    quality.alpha_stddev = std::sqrt(alpha_squares / count);
    quality.r_stddev = std::sqrt(r_squares / count);
  }
  return quality;
}

}  // namespace quoin
