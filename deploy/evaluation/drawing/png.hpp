// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace quoin::deploy {

/// The picture of an SVG text as a PNG file, as many pixels as it has units, times `scale`. Throws
/// std::runtime_error when it cannot be drawn, or rsvg-convert, which does it, is not installed.
[[nodiscard]] std::string png_of(const std::string& svg, double scale = 1.0);

}  // namespace quoin::deploy
