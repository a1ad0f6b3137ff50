// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/segmentation/hough.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "core/geometry/angle.hpp"
#include "core/sensor/multiversion.hpp"

namespace quoin {
namespace {

QUOIN_MULTIVERSION
std::size_t first_largest(const std::int32_t* values, std::size_t count) {
  std::int32_t largest = -1;
  for (std::size_t i = 0; i < count; ++i) largest = values[i] > largest ? values[i] : largest;
  std::size_t index = 0;
  while (index < count && values[index] != largest) ++index;
  return index;
}

}  // namespace

HoughVotes::HoughVotes(double angle_resolution, double offset_resolution)
    : offset_resolution_(offset_resolution) {
  const auto directions = static_cast<std::size_t>(std::ceil(pi / angle_resolution));
  for (std::size_t k = 0; k < directions; ++k) {
    const double alpha = pi * static_cast<double>(k) / static_cast<double>(directions);
    cosines_.push_back(std::cos(alpha));
    sines_.push_back(std::sin(alpha));
  }
}

void HoughVotes::start(const PointsView& points, const Segment& cluster) {
  const PointsView view = points.subview(cluster.begin, cluster.end);
  const auto [left, right] = std::minmax_element(view.x.begin(), view.x.end());
  const auto [bottom, top] = std::minmax_element(view.y.begin(), view.y.end());
  x_ = 0.5 * (*left + *right);
  y_ = 0.5 * (*bottom + *top);
  const double width = *right - *left;
  const double height = *top - *bottom;
  const double diagonal = std::sqrt(width * width + height * height);
  // Half a cell of margin on either side, against rounding.
  width_ = std::max(offset_resolution_, diagonal / static_cast<double>(most_offsets - 1));
  lowest_ = -0.5 * diagonal - 0.5 * width_;
  offsets_ = static_cast<std::size_t>(diagonal / width_) + 2;

  cells_.assign(cosines_.size() * offsets_, 0);
  first_ = cluster.begin;
  voting_.assign(cluster.size(), 1);
  for (std::size_t i = 0; i < view.size(); ++i) vote(view.x[i], view.y[i], 1);
}

void HoughVotes::vote(double x, double y, std::int32_t change) {
  const double scale = 1.0 / width_;
  const double px = (x - x_) * scale;
  const double py = (y - y_) * scale;
  const double lowest = lowest_ * scale;
  std::int32_t* row = cells_.data();
  for (std::size_t k = 0; k < cosines_.size(); ++k, row += offsets_) {
    const auto cell = static_cast<std::int32_t>(cosines_[k] * px + sines_[k] * py - lowest);
    row[cell] = row[cell] + change;
  }
}

HoughVotes::Peak HoughVotes::peak() const {
  const std::size_t index = first_largest(cells_.data(), cells_.size());
  if (index >= cells_.size()) return {};
  const std::size_t direction = index / offsets_;
  const auto cell = static_cast<double>(index % offsets_);
  Peak peak;
  peak.cell = index;
  peak.votes = cells_[index];
  peak.line.normal_x = cosines_[direction];
  peak.line.normal_y = sines_[direction];
  peak.line.offset =
      lowest_ + (cell + 0.5) * width_ + peak.line.normal_x * x_ + peak.line.normal_y * y_;
  return peak;
}

void HoughVotes::discard(std::size_t cell) {
  cells_[cell] = std::numeric_limits<std::int32_t>::min() / 2;
}

void HoughVotes::take_back(const PointsView& points, const Segment& run) {
  for (std::size_t i = run.begin; i < run.end; ++i) {
    if (voting_[i - first_] == 0) continue;
    voting_[i - first_] = 0;
    vote(points.x[i], points.y[i], -1);
  }
}

Hough::Hough(const Parameters& parameters)
    : fewest_(static_cast<std::size_t>(std::max(parameters.min_points, 3))),
      offset_resolution_(parameters.offset_resolution),
      builder_(parameters),
      votes_(parameters.angle_resolution, parameters.offset_resolution) {}

Segment Hough::best_run(const PointsView& points, const NormalLine& line,
                        std::size_t& range) const {
  // A point of the cell is up to half its width farther from the middle.
  Tolerance tolerance = builder_.tolerance();
  const double base = std::sqrt(tolerance.base) + 0.5 * offset_resolution_;
  tolerance.base = base * base;
  tolerance.largest = std::max(tolerance.largest, tolerance.base);
  Segment best{0, 0};
  for (std::size_t k = 0; k < free_.size(); ++k) {
    const Segment run = longest_run(points, free_[k], line, tolerance);
    if (run.size() <= best.size()) continue;
    best = run;
    range = k;
  }
  return best;
}

void Hough::search(const PointsView& points, const Segment& cluster) {
  found_.clear();
  free_.clear();
  free_.push_back(cluster);
  votes_.start(points, cluster);
  while (!free_.empty()) {
    const HoughVotes::Peak peak = votes_.peak();
    if (peak.votes < static_cast<std::int32_t>(fewest_)) break;
    std::size_t range = 0;
    const Segment near = best_run(points, peak.line, range);
    const Segment run = refined_run(points, moments_, free_[range], near, builder_.tolerance());
    votes_.take_back(points, near);
    if (run.size() < fewest_) {
      votes_.discard(peak.cell);
      continue;
    }
    votes_.take_back(points, run);
    found_.push_back(run);
    const Segment rest{run.end, free_[range].end};
    free_[range].end = run.begin;
    free_.insert(free_.begin() + static_cast<std::ptrdiff_t>(range) + 1, rest);
    std::erase_if(free_, [this](const Segment& segment) { return segment.size() < fewest_; });
  }
}

void Hough::operator()(const PointsView& scan, const SensorModel& sensor, Segmentation& found) {
  const PointsView points = builder_.start(scan, sensor);
  moments_.assign(points);
  for (const Segment& cluster : builder_.clusters()) {
    if (cluster.size() < fewest_) continue;
    search(points, cluster);
    builder_.add_all(found_);
  }
  builder_.finish(found);
}

}  // namespace quoin
