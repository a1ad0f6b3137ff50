// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "services/deployment/kind.hpp"
#include "services/deployment/known_outputs.hpp"
#include "services/viewer/settings.hpp"

namespace quoin {

[[nodiscard]] inline const KindInfo& viewer_kind() {
  static const KindInfo kind{
      .name = "viewer",
      .description =
          "a page that shows what services publish, live, and a WebSocket for Foxglove "
          "and Lichtblick",
      .program = "quoin-viewer",
      .observer = true,
      .known_outputs = known_outputs,
      .exclusive = true,
      .parameters = describe_parameters<viewer::ViewerParameters>()};
  return kind;
}

}  // namespace quoin
