// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>
#include <string>

namespace quoin {

/// Looks up an environment variable.
using Lookup = std::function<std::optional<std::string>(const std::string& name)>;

/// Variables of this process.
[[nodiscard]] std::optional<std::string> environment_variable(const std::string& name);

/// `text` with ${NAME} and ${NAME:-default} replaced; as in a shell, the default also stands in for
/// an empty variable, and may have variables itself. Throws std::invalid_argument when a variable
/// is not set, the form is wrong, or the text becomes longer than 4096 bytes.
[[nodiscard]] std::string replace_variables(const std::string& text, const Lookup& lookup);

}  // namespace quoin
