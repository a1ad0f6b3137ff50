// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <idl/Circles.h>

#include "core/circles/circle_fit.hpp"

namespace quoin::topics {

/// Appends the circle fitted to `points`, which are arc number `arc` of the scan, or the reason why
/// there is none.
void append_circle(const CircleFit& fit, const PointsView& points, std::uint32_t arc,
                   msg::Circles& out);

}  // namespace quoin::topics
