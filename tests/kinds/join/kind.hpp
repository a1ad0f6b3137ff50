// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "services/deployment/kind.hpp"

namespace quoin::tests {

/// Stands for localization: lines, and what a sensor of its own rate says at their stamp.
[[nodiscard]] inline const KindInfo& join_kind() {
  static const KindInfo kind{.name = "test_join",
                             .description = "lines, marked with the scans around their stamp",
                             .program = "quoin-test-join",
                             .inputs = {{"lines", "lines"}, {"scan", "scan", Join::by_time}},
                             .outputs = {{"lines"}}};
  return kind;
}

}  // namespace quoin::tests
