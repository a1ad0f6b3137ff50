// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "deploy/diagnostics/check.hpp"

#include <algorithm>

#include <nlohmann/json.hpp>

#include "core/text/printable.hpp"

namespace quoin::deploy {

std::string verdict_name(Verdict verdict) {
  switch (verdict) {
    case Verdict::good:
      return "ok";
    case Verdict::doubtful:
      return "doubtful";
    case Verdict::bad:
      break;
  }
  return "bad";
}

void print(const Check& check, std::ostream& out) {
  const std::string verdict = verdict_name(check.verdict);
  out << "  " << verdict << std::string(10 - verdict.size(), ' ') << check.name << ": "
      << printable(check.text) << '\n';
  if (!check.advice.empty()) out << "            -> " << printable(check.advice) << '\n';
}

nlohmann::ordered_json to_json(const Checks& checks) {
  auto list = nlohmann::ordered_json::array();
  for (const Check& check : checks) {
    list.push_back({{"check", check.name},
                    {"verdict", verdict_name(check.verdict)},
                    {"text", check.text},
                    {"advice", check.advice}});
  }
  return list;
}

bool all_good(const Checks& checks) {
  return std::all_of(checks.begin(), checks.end(),
                     [](const Check& check) { return check.verdict == Verdict::good; });
}

}  // namespace quoin::deploy
