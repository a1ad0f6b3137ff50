// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "core/segmentation/block_test.hpp"
#include "core/segmentation/pieces.hpp"
#include "core/segmentation/tolerance.hpp"
#include "core/sensor/points.hpp"

namespace quoin {

/// Unites neighbouring pieces of one round thing and marks them as round: a circle explains their
/// points and lines do not explain them better. The pieces have been fitted. `blocks` becomes the
/// blocks of each, tested unless it is round.
void find_arcs(const PointsView& points, const SensorModel& sensor, const Tolerance& tolerance,
               double flatness, std::vector<Piece>& pieces, std::vector<TestedBlocks>& blocks);

}  // namespace quoin
