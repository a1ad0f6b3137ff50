// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/calibration/wall_sample.hpp"

#include <algorithm>

namespace quoin {

void WallSample::add(std::size_t scan, const PointsView& points, std::span<const Segment> walls) {
  for (const Segment& wall : walls) {
    if (wall.size() < fewest_points) continue;
    const std::size_t begin = ranges_.size();
    for (std::size_t i = wall.begin; i < wall.end; ++i) {
      ranges_.push_back(static_cast<float>(points.range[i]));
      bearings_.push_back(static_cast<float>(points.bearing[i]));
    }
    walls_.push_back({scan, begin, ranges_.size()});
  }
}

template <class Keep>
void WallSample::keep_if(const Keep& keep) {
  std::size_t end = 0;
  std::size_t kept = 0;
  for (const Wall& candidate : walls_) {
    const Wall wall = candidate;
    if (!keep(wall)) continue;
    const auto move = [&](std::vector<float>& values) {
      std::copy(values.data() + wall.begin, values.data() + wall.end, values.data() + end);
    };
    move(ranges_);
    move(bearings_);
    walls_[kept++] = {wall.scan, end, end + wall.size()};
    end += wall.size();
  }
  walls_.resize(kept);
  ranges_.resize(end);
  bearings_.resize(end);
}

void WallSample::thin(std::size_t stride) {
  keep_if([stride](const Wall& wall) { return wall.scan % stride == 0; });
}

void WallSample::forget_before(std::size_t scan) {
  keep_if([scan](const Wall& wall) { return wall.scan >= scan; });
}

void WallSample::points_of(const Wall& wall, Points& points) const {
  convert_ordered(std::span(bearings_).subspan(wall.begin, wall.size()),
                  std::span(ranges_).subspan(wall.begin, wall.size()), points);
}

}  // namespace quoin
