// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "services/deployment/deployment.hpp"

namespace quoin::deploy {

enum class ChangeAction {
  keep,     ///< nothing is done to the process
  adjust,   ///< what only the supervisor needs to know has changed
  swap,     ///< method or parameters are exchanged in the running process
  start,    ///< new service
  replace,  ///< a new process takes over from the running one
  stop,     ///< the service is not wanted any more
};

[[nodiscard]] std::string_view action_name(ChangeAction action);

/// What happens to one service, or to one instance of it.
struct Change {
  ChangeAction action = ChangeAction::keep;
  std::string service;  ///< label
  std::string detail;   ///< what differs
  /// For replace: whether the new process gets the same scans as the old one, so that one scan can
  /// be named from which it takes over.
  bool same_scans = true;
};

/// How to get from one deployment to another with the least change.
struct Plan {
  std::vector<Change> changes;  ///< inputs before those who read them, then what is stopped
  /// Why it cannot be done while the deployment runs, as "what; what to do"; usually empty.
  std::vector<std::string> obstacles;

  [[nodiscard]] const Change& of(std::string_view service) const;
  [[nodiscard]] bool replaces(std::string_view service) const;
  [[nodiscard]] bool stops(std::string_view service) const;
  /// Whether no process is touched.
  [[nodiscard]] bool nothing_to_do() const;
};

/// For the services that run on `host`.
[[nodiscard]] Plan plan_changes(const Deployment& running, const Deployment& wanted,
                                const std::string& host = "");

/// "replace walls: input front -> rear"
[[nodiscard]] std::string to_text(const Change& change);

}  // namespace quoin::deploy
