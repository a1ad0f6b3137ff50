// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "services/deployment/kind.hpp"

namespace quoin::tests {

/// Stands for a bridge to something that is no DDS.
[[nodiscard]] inline const KindInfo& sink_kind() {
  static const KindInfo kind{.name = "test_sink",
                             .description = "takes corners and publishes nothing",
                             .program = "quoin-test-sink",
                             .inputs = {{"corners", "corners"}}};
  return kind;
}

}  // namespace quoin::tests
