// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/circles/algebraic_fitters.hpp"
#include "core/circles/maximum_likelihood_circle.hpp"
#include "core/parameters/method_list.hpp"

namespace quoin {

/// All circle fitters, the default first.
using CircleFitters = MethodList<MaximumLikelihoodCircle, TaubinCircle, PrattCircle, HyperCircle>;

}  // namespace quoin
