// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "services/deployment/kind.hpp"
#include "tests/kinds/own_rate/counters.hpp"

namespace quoin::tests {

/// Stands for mapping: it knows more with each message, and publishes now and then.
[[nodiscard]] inline const KindInfo& own_rate_kind() {
  static const KindInfo kind{.name = "test_own_rate",
                             .description = "every Nth time, how many corners messages came so far",
                             .program = "quoin-test-own-rate",
                             .inputs = {{"corners", "corners"}},
                             .outputs = {{"corners", Rate::own_rate}},
                             .methods = Counters::descriptions()};
  return kind;
}

}  // namespace quoin::tests
