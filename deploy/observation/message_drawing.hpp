// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <idl/Circles.h>
#include <idl/Corners.h>
#include <idl/Lines.h>
#include <span>
#include <string>

#include "deploy/evaluation/drawing/drawing.hpp"

namespace quoin::deploy {

/// Rays [rad, m] as points; without those that met nothing.
void add_points(std::span<const float> bearings, std::span<const float> ranges, Drawing& drawing);
void add_lines(const msg::Lines& message, Drawing& drawing);
void add_corners(const msg::Corners& message, Drawing& drawing);
void add_circles(const msg::Circles& message, Drawing& drawing);

/// The services that a message came through, with their methods.
[[nodiscard]] std::string stages_text(const msg::Header& header);

}  // namespace quoin::deploy
