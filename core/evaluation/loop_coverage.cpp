// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/evaluation/loop_coverage.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "core/evaluation/corner_matching.hpp"
#include "core/evaluation/scene.hpp"
#include "core/fitting/line_difference.hpp"
#include "core/geometry/angle.hpp"
#include "core/statistics/chi_square.hpp"

namespace quoin {
namespace {

constexpr double same_alpha = 1e-6;     // [rad]
constexpr double same_distance = 1e-3;  // [m]

/// The lines of the walls as seen from a pose; walls of one line have the same number.
struct WallLines {
  std::vector<Line> lines;
  std::vector<std::size_t> line_of_wall;

  WallLines(const World& world, const Pose2& pose) {
    for (const Wall& wall : world.walls) {
      const Line line = wall_line(wall, pose);
      const auto same = std::ranges::find_if(lines, [&](const Line& other) {
        return std::abs(normalized_angle(line.alpha - other.alpha)) <= same_alpha &&
               std::abs(line.r - other.r) <= same_distance;
      });
      line_of_wall.push_back(static_cast<std::size_t>(same - lines.begin()));
      if (same == lines.end()) lines.push_back(line);
    }
  }
};

/// Which line each point of a scan is truly on.
class TrueLines {
 public:
  void assign(const SimulatedScan& scan, const WallLines& walls) {
    by_bearing_.clear();
    for (std::size_t i = 0; i < scan.walls.size(); ++i) {
      const bool on_wall = scan.walls[i] != Hit::no_wall && std::isfinite(scan.ranges[i]);
      by_bearing_.emplace_back(static_cast<double>(scan.bearings[i]),
                               on_wall ? walls.line_of_wall[scan.walls[i]] : Hit::no_wall);
    }
    std::ranges::sort(by_bearing_);
    counts_.assign(walls.lines.size(), 0);
  }

  /// The line that more than half of the points are on, or Hit::no_wall.
  [[nodiscard]] std::size_t of(const PointsView& points) {
    std::ranges::fill(counts_, 0);
    for (const double bearing : points.bearing) {
      const auto at = std::ranges::lower_bound(by_bearing_, std::pair(bearing, std::size_t{0}));
      if (at == by_bearing_.end() || at->first != bearing || at->second == Hit::no_wall) continue;
      ++counts_[at->second];
    }
    const auto most = std::ranges::max_element(counts_);
    if (most == counts_.end() || 2 * *most <= points.size()) return Hit::no_wall;
    return static_cast<std::size_t>(most - counts_.begin());
  }

 private:
  std::vector<std::pair<double, std::size_t>> by_bearing_;
  std::vector<std::size_t> counts_;
};

class LineTally {
 public:
  void add(const Extraction& extraction, const WallLines& walls, TrueLines& truth) {
    std::size_t covered = 0;
    std::size_t true_lines = 0;
    for (std::size_t k = 0; k < extraction.lines().size(); ++k) {
      const LineSegment& line = extraction.lines()[k];
      if ((line.end - line.start).norm() < judged_line_length) continue;
      ++lines_;
      const Segment& segment = extraction.fitted()[k];
      const std::size_t of =
          truth.of(extraction.points().view().subview(segment.begin, segment.end));
      if (of == Hit::no_wall) continue;
      ++true_lines;
      const double squared = squared_error(line, walls.lines[of]);
      covered += squared <= chi_square_2_95 ? 1 : 0;
      beyond_ += squared <= four_sigma_squared ? 0 : 1;
    }
    coverage_.add(covered, true_lines);
  }

  [[nodiscard]] LineQuality quality() const {
    LineQuality quality;
    quality.lines = lines_;
    quality.false_lines = lines_ - coverage_.trials();
    quality.coverage = coverage_.interval();
    if (coverage_.trials() > 0) {
      quality.beyond_four_sigma =
          static_cast<double>(beyond_) / static_cast<double>(coverage_.trials());
    }
    return quality;
  }

 private:
  std::size_t lines_ = 0;
  std::size_t beyond_ = 0;
  ClusteredProportion coverage_;
};

}  // namespace

LoopCoverage judge_loop(Extraction& extraction, std::span<const World> worlds,
                        const DisturbedScans& disturbed) {
  LoopCoverage result;
  CornerTally corners;
  LineTally lines;
  TrueLines true_lines;
  std::size_t segments = 0;
  for (std::size_t w = 0; w < worlds.size(); ++w) {
    const Pose2 pose = worlds[w].pose_at(0.0);
    const CornerTruth truth = corner_truth(worlds[w], pose, disturbed.rays);
    const WallLines walls(worlds[w], pose);
    corners.begin_world();
    DisturbedScanner scanner(worlds[w], disturbed, disturbed.seed + w);
    for (std::size_t k = 0; k < disturbed.scans; ++k) {
      true_lines.assign(scanner.scan(), walls);
      extraction.run(scanner.view(), disturbed.noise, disturbed.noise);
      ++result.scans;
      segments += extraction.segments().size();
      extraction.count_failures(result.failures);
      corners.add(extraction.corners(), truth);
      lines.add(extraction, walls, true_lines);
    }
  }
  if (result.scans == 0) return result;
  result.corners = corners.quality();
  result.lines = lines.quality();
  const auto scans = static_cast<double>(result.scans);
  result.segments_per_scan = static_cast<double>(segments) / scans;
  result.corners_per_scan = static_cast<double>(result.corners.found_corners) / scans;
  return result;
}

}  // namespace quoin
