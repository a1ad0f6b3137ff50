// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/mapping/line_map.hpp"

#include <algorithm>
#include <cmath>

#include "core/geometry/angle.hpp"

namespace quoin {
namespace {

/// Difference of two directions of lines without sense, in (-pi/2, pi/2] [rad].
double angle_of_lines(double angle) {
  const double reduced = std::remainder(angle, pi);
  return reduced <= -0.5 * pi ? 0.5 * pi : reduced;
}

}  // namespace

double MapLine::direction() const { return direction_of(end.x() - start.x(), end.y() - start.y()); }

LineMap::LineMap(double largest_angle, double largest_distance)
    : largest_angle_(largest_angle), largest_distance_(largest_distance) {}

LineMap::Cell LineMap::cell_of(const Eigen::Vector2d& point, int right, int up) const {
  // Far from the origin cells repeat; lines of both are compared then.
  const auto index = [&](double value, int step) {
    const double cell = std::floor(value / largest_distance_) + step;
    return static_cast<std::uint32_t>(
        static_cast<std::int64_t>(std::clamp(cell, -0x1p31, 0x1p31 - 1.0)));
  };
  return static_cast<Cell>(index(point.x(), right)) << 32U | index(point.y(), up);
}

std::optional<LineMatch> LineMap::find(const Eigen::Vector2d& start,
                                       const Eigen::Vector2d& end) const {
  const Eigen::Vector2d centroid = 0.5 * (start + end);
  const double direction = direction_of(end.x() - start.x(), end.y() - start.y());
  std::optional<LineMatch> best;
  for (int right = -1; right <= 1; ++right) {
    for (int up = -1; up <= 1; ++up) {
      const auto cell = cells_.find(cell_of(centroid, right, up));
      if (cell == cells_.end()) continue;
      for (const std::size_t index : cell->second) {
        const MapLine& line = lines_[index];
        const Eigen::Vector2d middle = line.middle();
        const double apart = (middle - centroid).norm();
        if (!(apart < largest_distance_)) continue;
        const double stored = line.direction();
        const double offset = angle_of_lines(stored - direction);
        if (!(std::abs(offset) < largest_angle_)) continue;
        // Signed distances from the origin, by normals to the same side.
        const double turned = stored - offset;
        const double stored_distance =
            std::cos(stored) * middle.y() - std::sin(stored) * middle.x();
        const double distance = std::cos(turned) * centroid.y() - std::sin(turned) * centroid.x();
        const LineMatch match{index, std::abs(stored_distance - distance) + apart, offset};
        if (!(match.distance < largest_distance_)) continue;
        if (!best || match.distance < best->distance ||
            (match.distance == best->distance && index < best->index)) {
          best = match;
        }
      }
    }
  }
  return best;
}

std::size_t LineMap::add(const Eigen::Vector2d& start, const Eigen::Vector2d& end) {
  MapLine line;
  line.start = start;
  line.end = end;
  line.observations = 1;
  return add(line);
}

std::size_t LineMap::add(const MapLine& line) {
  const std::size_t index = lines_.size();
  lines_.push_back(line);
  lines_.back().id = index;
  cells_[cell_of(line.middle())].push_back(index);
  return index;
}

void LineMap::extend(std::size_t index, const Eigen::Vector2d& start, const Eigen::Vector2d& end) {
  MapLine& line = lines_[index];
  ++line.observations;
  const double length = line.length();
  if (!(length > 0.0)) return;
  const Eigen::Vector2d along = (line.end - line.start) / length;
  const double first = along.dot(start - line.start);
  const double second = along.dot(end - line.start);
  const double low = std::min({0.0, first, second});
  const double high = std::max({length, first, second});
  if (low == 0.0 && high == length) return;
  const Cell before = cell_of(line.middle());
  const Eigen::Vector2d origin = line.start;
  if (low < 0.0) line.start = origin + low * along;
  if (high > length) line.end = origin + high * along;
  const Cell after = cell_of(line.middle());
  if (before == after) return;
  std::erase(cells_[before], index);
  cells_[after].push_back(index);
}

std::size_t LineMap::merge(const Eigen::Vector2d& start, const Eigen::Vector2d& end) {
  const std::optional<LineMatch> match = find(start, end);
  if (!match) return add(start, end);
  extend(match->index, start, end);
  return match->index;
}

void LineMap::restore_cells() {
  cells_.clear();
  for (std::size_t i = 0; i < lines_.size(); ++i) {
    cells_[cell_of(lines_[i].middle())].push_back(i);
  }
}

void LineMap::clear() {
  lines_.clear();
  cells_.clear();
}

}  // namespace quoin
