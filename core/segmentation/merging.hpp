// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "core/segmentation/piece.hpp"
#include "core/segmentation/tolerance.hpp"

namespace quoin {

/// Joins neighbours that are one line within the tolerance, which noise or clutter had split; best
/// match first, because a short piece may suit both sides. The pieces have been fitted.
void merge_collinear(const PointsView& points, const Tolerance& tolerance,
                     std::vector<Piece>& pieces);

}  // namespace quoin
