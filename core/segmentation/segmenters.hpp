// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/methods/method_list.hpp"
#include "core/segmentation/iepf.hpp"

namespace quoin {

/// All segmenters, the default first.
using Segmenters = MethodList<Iepf>;

}  // namespace quoin
