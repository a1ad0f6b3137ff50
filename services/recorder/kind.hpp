// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "services/deployment/kind.hpp"
#include "services/deployment/known_outputs.hpp"
#include "services/recorder/parameters.hpp"

namespace quoin {

[[nodiscard]] inline const KindInfo& recorder_kind() {
  static const KindInfo kind{.name = "recorder",
                             .description = "records what services publish in an MCAP file",
                             .program = "quoin-recorder",
                             .observer = true,
                             .known_outputs = known_outputs,
                             .exclusive = true,
                             .parameters = describe_parameters<RecorderParameters>()};
  return kind;
}

}  // namespace quoin
