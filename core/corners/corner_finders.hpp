// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/corners/adjacent.hpp"
#include "core/parameters/method_list.hpp"

namespace quoin {

/// All corner finders, the default first.
using CornerFinders = MethodList<Adjacent>;

}  // namespace quoin
