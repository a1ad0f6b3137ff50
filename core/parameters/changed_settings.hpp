// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "core/parameters/parameter.hpp"

namespace quoin {

/// What `to` gives another value than `from` does, whatever the units they are written in; what is
/// not set has its default.
[[nodiscard]] ParameterSettings changed_settings(const std::vector<ParameterInfo>& infos,
                                                 const ParameterSettings& from,
                                                 const ParameterSettings& to);

}  // namespace quoin
