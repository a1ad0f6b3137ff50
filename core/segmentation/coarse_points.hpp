// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "core/sensor/points.hpp"

namespace quoin {

/// Points of a scan in single precision, which is micrometres: enough to tell where a surface ends
/// or a chord is left, in half the time. Lines are fitted in double precision. Keeps its memory.
struct CoarsePoints {
  std::vector<float> range, x, y;  ///< [m]

  void assign(const PointsView& points);
  [[nodiscard]] std::size_t size() const { return range.size(); }
};

}  // namespace quoin
