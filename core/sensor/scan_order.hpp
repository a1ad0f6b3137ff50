// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>

namespace quoin {

/// How the points of a scan are to be read so that they run counter-clockwise from a break.
struct ScanOrder {
  bool clockwise = false;  ///< acquired clockwise: read backwards
  std::size_t first = 0;   ///< index, in the order of acquisition, of the point to start with
  std::size_t count = 0;   ///< points to read; one less than given when the last repeats the first
};

/// Bearings [rad] and ranges [m] of valid points in the order of acquisition; that order is
/// trusted, because noise of the bearings may swap neighbours. Both spans have the same length.
[[nodiscard]] ScanOrder scan_order(std::span<const float> bearings, std::span<const float> ranges);

}  // namespace quoin
