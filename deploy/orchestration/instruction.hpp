// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>

namespace quoin::deploy {

/// What who brings several hosts together wants one of them to do next, once it is ready.
struct Instruction {
  enum class Kind { change, finish, withdraw };
  Kind kind = Kind::withdraw;
  std::string text;  ///< the service to change, or why to withdraw
};

/// The reason that a host gives which was instructed to withdraw: not its own.
inline constexpr const char* withdrawn =
    "withdrawn; another host is not ready, or quoin apply was interrupted";

/// Waits for the next instruction; `begun` says whether it is too late to withdraw.
using NextInstruction = std::function<Instruction(bool begun)>;

}  // namespace quoin::deploy
