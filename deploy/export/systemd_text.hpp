// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace quoin::deploy {

/// One word of a list in a unit file, such that systemd reads `text` again: in quotes where needed,
/// specifiers (%) and escapes (\) doubled.
[[nodiscard]] std::string unit_word(std::string_view text);

/// The same for an argument of ExecStart=, where $ begins a variable.
[[nodiscard]] std::string unit_argument(std::string_view text);

/// The same for its first word, the program, where $ stands for itself. Throws
/// std::invalid_argument for what systemd takes in no form: quotes, backslashes, control
/// characters.
[[nodiscard]] std::string unit_program(std::string_view path);

/// For comments: on one line, whatever it holds.
[[nodiscard]] std::string unit_comment(std::string_view text);

}  // namespace quoin::deploy
