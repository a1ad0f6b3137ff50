// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/fitting/fitters.hpp"

namespace quoin {

template Fitter Fitters::make<Fitter>(std::string_view, const ParameterSettings&);

}  // namespace quoin
