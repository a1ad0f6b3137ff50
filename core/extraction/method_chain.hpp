// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "core/parameters/parameter.hpp"

namespace quoin {

/// A method with its settings, as a service runs it. Values are texts with or without a unit:
/// {"iepf", {{"split_distance", "40 mm"}}}. `quoin methods` and docs/methods.md list what there is.
struct MethodChoice {
  std::string method;
  ParameterSettings settings = {};
};

/// The methods from points to corners, by default those of the services.
struct MethodChain {
  MethodChoice segmenter = {"iepf"};
  MethodChoice fitter = {"inverse_range"};
  MethodChoice finder = {"adjacent"};
};

}  // namespace quoin
