// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/fitting/arras_siegwart.hpp"
#include "core/fitting/cwlf.hpp"
#include "core/fitting/inverse_range.hpp"
#include "core/fitting/least_squares.hpp"
#include "core/fitting/maximum_likelihood.hpp"
#include "core/fitting/pca.hpp"
#include "core/fitting/utls.hpp"
#include "core/fitting/wctls.hpp"
#include "core/fitting/wtls.hpp"
#include "core/parameters/method_list.hpp"

namespace quoin {

/// All line fitters, the default first.
using Fitters = MethodList<InverseRange, Wctls, Utls, Wtls, Cwlf, ArrasSiegwart, Pca, LeastSquares,
                           MaximumLikelihood>;

}  // namespace quoin
