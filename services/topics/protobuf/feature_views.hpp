// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <foxglove/foxglove.pb.h>
#include <idl/Circles.h>
#include <idl/Corners.h>
#include <idl/Lines.h>

namespace quoin::topics {

/// A stroke from end to end a line, with its values and their standard deviations.
bool show_lines(const msg::Lines& message, foxglove::SceneUpdate& out);

/// A cross and the 95 % ellipse a corner, with its values and the standard deviation as a text.
bool show_corners(const msg::Corners& message, foxglove::SceneUpdate& out);

/// The arc that was seen of each circle, and the 95 % ellipse of its centre.
bool show_circles(const msg::Circles& message, foxglove::SceneUpdate& out);

}  // namespace quoin::topics
