// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "core/segmentation/piece.hpp"
#include "core/segmentation/segmentation_parameters.hpp"
#include "core/segmentation/tolerance.hpp"

namespace quoin {

/// Appends to `segments` the pieces that are lines somebody can use:
/// - of `min_points` points and `min_length`; half of that beside a joined piece that is long
///   enough, because small pieces with nothing beside them are mostly of clutter,
/// - longer than the band of their tolerance is wide: noise makes short ones out of nothing,
/// - not bent: table legs, bins and people are round, and pieces of them fit into the tolerance.
///   Bent is what has a sagitta of more than a twentieth of its length that noise does not explain.
void select_lines(const PointsView& points, const std::vector<Piece>& pieces,
                  const SegmentationParameters& parameters, const SensorModel& sensor,
                  const Tolerance& tolerance, std::vector<Segment>& segments);

}  // namespace quoin
