// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

namespace quoin::deploy {

/// What keeps a user without rights from reading `file` (or, `executable`, from executing it) in a
/// unit that hides home and temporary folders; "" when nothing does.
[[nodiscard]] std::string obstacle_to_others(const std::filesystem::path& file, bool executable);

}  // namespace quoin::deploy
