// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/fitting/algebraic.hpp"
#include "core/fitting/axis_regression.hpp"
#include "core/fitting/likelihood_fitters.hpp"
#include "core/fitting/orthogonal.hpp"
#include "core/parameters/method_list.hpp"

namespace quoin {

/// All line fitters, the default first.
using Fitters = MethodList<InverseRange, Wctls, Utls, Wtls, Cwlf, ArrasSiegwart, Pca, LeastSquares,
                           MaximumLikelihood>;

}  // namespace quoin
