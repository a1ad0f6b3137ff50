// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "core/extraction/extraction.hpp"
#include "core/geometry/corner.hpp"
#include "deploy/evaluation/drawing/drawing.hpp"

namespace quoin::deploy {

[[nodiscard]] DrawnPoint drawn(const Eigen::Vector2d& point);
/// `mahalanobis_squared` says which ellipse: 1 is one sigma.
[[nodiscard]] DrawnCorner drawn(const CornerEstimate& corner, double mahalanobis_squared,
                                std::size_t series = 0);

/// What the last scan of `extraction` gave, with 95 % ellipses.
[[nodiscard]] Drawing picture(const Extraction& extraction);

}  // namespace quoin::deploy
