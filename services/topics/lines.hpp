// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <idl/Lines.h>
#include <vector>

#include "core/fitting/fit.hpp"
#include "core/geometry/line.hpp"

namespace quoin::topics {

/// Appends the line fitted to segment number `segment` of the scan.
void append_line(const LineSegment& line, double chi_square, std::uint32_t segment,
                 msg::Lines& out);

void append_failure(FitFailure failure, std::uint32_t segment, msg::Lines& out);

/// The lines of a message; the vector is cleared first.
void line_segments(const msg::Lines& message, std::vector<LineSegment>& out);

}  // namespace quoin::topics
