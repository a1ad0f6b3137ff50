// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/segmentation/segmenters.hpp"
#include "services/deployment/kind.hpp"

namespace quoin {

[[nodiscard]] inline const KindInfo& segmentation_kind() {
  static const KindInfo kind{
      .name = "segmentation",
      .description = "splits each scan into runs of points on one straight wall",
      .program = "quoin-segmentation",
      .inputs = {{"scan", "scan"}},
      .outputs = {{"segments"}},
      .methods = Segmenters::descriptions()};
  return kind;
}

}  // namespace quoin
