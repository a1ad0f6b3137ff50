// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/deployment/problems.hpp"

#include <algorithm>

namespace quoin {

namespace {
// Enough for a human; a file of garbage would otherwise answer with megabytes.
constexpr std::size_t most_shown = 50;
}  // namespace

void Problems::raise() const {
  if (problems_.empty()) return;
  auto sorted = problems_;
  std::stable_sort(sorted.begin(), sorted.end(), [](const auto& a, const auto& b) {
    return std::pair(a.first.line, a.first.column) < std::pair(b.first.line, b.first.column);
  });
  std::vector<std::string> messages;
  for (const auto& [where, what] : sorted) {
    if (messages.size() == most_shown) {
      messages.push_back(file_.string() + ": and " + std::to_string(sorted.size() - most_shown) +
                         " more");
      break;
    }
    const std::string place = file_.string() + ":" + std::to_string(where.line) + ":" +
                              std::to_string(where.column) + ": ";
    messages.push_back((file_.empty() ? "" : place) + what);
  }
  throw DeploymentError(std::move(messages));
}

}  // namespace quoin
