// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "services/deployment/kind.hpp"
#include "services/deskewing/parameters.hpp"

namespace quoin {

[[nodiscard]] inline const KindInfo& deskewing_kind() {
  static const KindInfo kind{
      .name = "deskewing",
      .description = "scans of a moving sensor as if all rays were cast from where the first was",
      .program = "quoin-deskewing",
      .inputs = {{"scan", "scan"},
                 {"odometry", "odometry", Join::by_time, false},
                 {"pose", "pose", Join::by_time, false}},
      .outputs = {{"scan"}},
      .parameters = describe_parameters<DeskewingParameters>()};
  return kind;
}

}  // namespace quoin
