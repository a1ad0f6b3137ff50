// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/parameters/parameter.hpp"

namespace quoin::sensor_bridge {

/// Throws ParameterError unless `parameters.range_min` is below `parameters.range_max`.
template <class Parameters>
void check_range_limits(const Parameters& parameters) {
  if (parameters.range_min >= parameters.range_max) {
    throw ParameterError("range_min", "range_min must be below range_max");
  }
}

}  // namespace quoin::sensor_bridge
