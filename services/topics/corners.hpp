// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <idl/Corners.h>
#include <string>

#include "core/corners/corner_finder.hpp"

namespace quoin::topics {

/// Everything but the header.
void fill_corners(const FoundCorners& found, const std::string& covariance_mode, msg::Corners& out);

}  // namespace quoin::topics
