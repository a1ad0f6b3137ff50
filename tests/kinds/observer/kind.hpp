// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "services/deployment/kind.hpp"
#include "services/deployment/known_outputs.hpp"

namespace quoin::tests {

/// Stands for a recorder: reads whatever there is.
[[nodiscard]] inline const KindInfo& observer_kind() {
  static const KindInfo kind{.name = "test_observer",
                             .description = "counts the messages of each topic",
                             .program = "quoin-test-observer",
                             .observer = true,
                             .known_outputs = known_outputs};
  return kind;
}

}  // namespace quoin::tests
