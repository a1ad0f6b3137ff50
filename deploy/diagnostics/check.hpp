// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ostream>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

namespace quoin::deploy {

enum class Verdict { good, doubtful, bad };

/// "ok", "doubtful", "bad".
[[nodiscard]] std::string verdict_name(Verdict verdict);

/// One thing that was looked at.
struct Check {
  std::string name;
  Verdict verdict = Verdict::good;
  std::string text;    ///< what was found and, when it is not good, why that matters
  std::string advice;  ///< what to do; empty when it is good
};
using Checks = std::vector<Check>;

void print(const Check& check, std::ostream& out);
[[nodiscard]] nlohmann::ordered_json to_json(const Checks& checks);
[[nodiscard]] bool all_good(const Checks& checks);

}  // namespace quoin::deploy
