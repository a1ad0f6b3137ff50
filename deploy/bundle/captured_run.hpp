// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <string>
#include <vector>

namespace quoin::deploy {

/// What a program printed, standard error included, with how it ended behind it where that was not
/// well: its exit code, that it was stopped after `longest`, or that it could not be started. The
/// first word is looked for in PATH unless it has a slash.
[[nodiscard]] std::string captured_run(const std::vector<std::string>& words,
                                       std::chrono::milliseconds longest);

}  // namespace quoin::deploy
