// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/circles/circle_fitters.hpp"
#include "services/deployment/kind.hpp"

namespace quoin {

[[nodiscard]] inline const KindInfo& circle_fitting_kind() {
  static const KindInfo kind{.name = "circle_fitting",
                             .description = "fits a circle with its covariance to each arc",
                             .program = "quoin-circle-fitting",
                             .inputs = {{"segments", "segments"}},
                             .outputs = {{"circles"}},
                             .methods = CircleFitters::descriptions()};
  return kind;
}

}  // namespace quoin
