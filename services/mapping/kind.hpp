// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "services/deployment/kind.hpp"
#include "services/localization/parameters.hpp"

namespace quoin {

[[nodiscard]] inline const KindInfo& mapping_kind() {
  static const KindInfo kind{
      .name = "mapping",
      .description = "makes a map of lines and says where the robot is in it",
      .program = "quoin-mapping",
      .inputs = localizer_inputs(),
      .outputs = {{"pose"}, {"line_map", Rate::own_rate}},
      .methods =
          with_parameters(Mappers::descriptions(), describe_parameters<MappingParameters>())};
  return kind;
}

}  // namespace quoin
