// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "services/deployment/kind.hpp"

namespace quoin::deploy {

/// JSON Schema (draft 7) of the deployment file, for editors: keys, kinds, methods and parameters
/// with their descriptions, limits and defaults. It accepts every valid file, and some that are
/// not: what one entry says of another is for `quoin check`.
[[nodiscard]] nlohmann::ordered_json deployment_schema(const KindList& kinds);

}  // namespace quoin::deploy
