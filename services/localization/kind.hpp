// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "services/deployment/kind.hpp"
#include "services/localization/parameters.hpp"

namespace quoin {

[[nodiscard]] inline const KindInfo& localization_kind() {
  static const KindInfo kind{.name = "localization",
                             .description = "says where the robot is in a given map of lines",
                             .program = "quoin-localization",
                             .inputs = localizer_inputs(),
                             .outputs = {{"pose"}, {"line_map", Rate::own_rate}},
                             .methods = with_parameters(Localizers::descriptions(),
                                                        describe_parameters<GivenMapParameters>())};
  return kind;
}

}  // namespace quoin
