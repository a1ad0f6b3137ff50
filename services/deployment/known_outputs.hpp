// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "services/deployment/kind.hpp"

namespace quoin {

/// Outputs of this project's kinds, with the parameters that they depend on, for observers, whose
/// programs know their own kind only: they read what others publish, and may read nothing else
/// under `security:`. Null for other kinds, which may give anything. A test holds it against the
/// kinds.
[[nodiscard]] const KindInfo* known_outputs(std::string_view kind);

}  // namespace quoin
