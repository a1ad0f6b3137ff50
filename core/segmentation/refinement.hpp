// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "core/segmentation/piece.hpp"
#include "core/segmentation/tolerance.hpp"

namespace quoin {

/// Moves the boundaries between neighbours to where their lines meet. A vertex is chosen for being
/// far from a line, that is also for its noise, and is a few points off the corner: one wall's fit
/// then contains points of the other. The boundary goes to the bearing of the intersection, and the
/// point nearest to the corner on either side is left out, because noise decides which wall it
/// seems to be on. No point ends up farther than the tolerance from the line it was moved to.
///
/// `closed` says that the last piece and the first are joined too, across the seam; there points
/// are only left out. The pieces have been fitted.
void refine_boundaries(const PointsView& points, std::size_t min_points, const Tolerance& tolerance,
                       bool closed, std::vector<Piece>& pieces);

}  // namespace quoin
