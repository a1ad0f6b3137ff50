// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "core/sensor/points.hpp"
#include "core/sensor/sensor_model.hpp"

namespace quoin {

/// Points [begin, end) of a scan that lie on one straight wall.
struct Segment {
  std::size_t begin = 0;
  std::size_t end = 0;

  [[nodiscard]] std::size_t size() const { return end - begin; }
  friend bool operator==(const Segment&, const Segment&) = default;
};

/// Splits the points of a scan (as `convert` made them) into ascending, disjoint segments. The
/// vector is cleared first and keeps its memory. May keep working memory between calls.
using Segmenter = std::function<void(const PointsView&, const SensorModel&, std::vector<Segment>&)>;

}  // namespace quoin
