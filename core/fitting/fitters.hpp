// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/fitting/utls.hpp"
#include "core/fitting/wctls.hpp"
#include "core/fitting/wtls.hpp"
#include "core/methods/method_list.hpp"

namespace quoin {

/// All line fitters, the default first.
using Fitters = MethodList<Wctls, Utls, Wtls>;

}  // namespace quoin
