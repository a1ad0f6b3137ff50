// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/fitting/fitters.hpp"
#include "services/deployment/kind.hpp"

namespace quoin {

[[nodiscard]] inline const KindInfo& line_fitting_kind() {
  static const KindInfo kind{.name = "line_fitting",
                             .description = "fits a line with its covariance to each segment",
                             .program = "quoin-line-fitting",
                             .inputs = {{"segments", "segments"}},
                             .outputs = {{"lines"}},
                             .methods = Fitters::descriptions()};
  return kind;
}

}  // namespace quoin
