// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>

#include "core/segmentation/segment.hpp"

namespace quoin {

/// Whether value `i` is above `limit` and the largest of those up to `reach` places away inside
/// `range`; of equal ones the first is.
[[nodiscard]] bool is_peak(std::span<const double> values, const Segment& range, std::size_t i,
                           std::size_t reach, double limit);

}  // namespace quoin
