// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "services/deployment/kind.hpp"

namespace quoin::tests {

/// Stands for what needs the newest of something that changes seldom, and can do without.
[[nodiscard]] inline const KindInfo& latest_kind() {
  static const KindInfo kind{
      .name = "test_latest",
      .description = "for each scan the newest corners",
      .program = "quoin-test-latest",
      .inputs = {{"scan", "scan"}, {"corners", "corners", Join::latest, false}},
      .outputs = {{"corners"}}};
  return kind;
}

}  // namespace quoin::tests
