// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "core/parameters/parameter.hpp"

namespace quoin::deploy {

[[nodiscard]] std::string type_name(ParameterType type);

/// What may be written: "real 0..1", "integer 2..", "propagated or as_published".
[[nodiscard]] std::string range_text(const ParameterInfo& info);

/// '' for an empty text.
[[nodiscard]] std::string default_text(const ParameterInfo& info);

}  // namespace quoin::deploy
