// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/mapping/angular_offsets.hpp"
#include "core/mapping/landmarks.hpp"
#include "core/parameters/method_list.hpp"

namespace quoin {

/// The methods of localization and mapping: Localizers::make<Localizer>(name, settings).
using Localizers = MethodList<Landmarks, AngularOffsets>;

}  // namespace quoin
