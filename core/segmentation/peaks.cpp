// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/segmentation/peaks.hpp"

#include <algorithm>

namespace quoin {

bool is_peak(std::span<const double> values, const Segment& range, std::size_t i, std::size_t reach,
             double limit) {
  if (!(values[i] > limit)) return false;
  const std::size_t first = i - std::min(reach, i - range.begin);
  const std::size_t end = i + 1 + std::min(reach, range.end - i - 1);
  for (std::size_t k = first; k < i; ++k) {
    if (values[k] >= values[i]) return false;
  }
  for (std::size_t k = i + 1; k < end; ++k) {
    if (values[k] > values[i]) return false;
  }
  return true;
}

}  // namespace quoin
