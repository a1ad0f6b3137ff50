// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <nlohmann/json_fwd.hpp>

#include "services/deployment/kind.hpp"

namespace quoin::deploy {

/// A kind with its methods and parameters. The names in it are an interface: they may be added to,
/// not changed.
[[nodiscard]] nlohmann::ordered_json description_json(const KindInfo& kind);

/// "reads segments, publishes lines"
[[nodiscard]] std::string ports_text(const KindInfo& kind);

/// The same for the terminal.
[[nodiscard]] std::string description_text(const KindInfo& kind);

}  // namespace quoin::deploy
