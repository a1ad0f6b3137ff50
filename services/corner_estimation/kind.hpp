// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/corners/corner_finders.hpp"
#include "services/deployment/kind.hpp"

namespace quoin {

[[nodiscard]] inline const KindInfo& corner_estimation_kind() {
  static const KindInfo kind{
      .name = "corner_estimation",
      .description = "intersects neighbouring lines to corners with their covariances",
      .program = "quoin-corner-estimation",
      .inputs = {{"lines", "lines"}},
      .outputs = {{"corners"}},
      .methods = CornerFinders::descriptions()};
  return kind;
}

}  // namespace quoin
