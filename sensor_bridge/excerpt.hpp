// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "core/text/printable.hpp"

namespace quoin::sensor_bridge {

/// A piece of an input file for a message: in quotes, shortened and printable.
[[nodiscard]] inline std::string excerpt(std::string_view text) {
  constexpr std::size_t longest = 40;
  return "'" + printable(text, Lines::one, longest) + "'";
}

}  // namespace quoin::sensor_bridge
