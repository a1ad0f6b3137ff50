// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "deploy/kinds/kinds.hpp"

namespace quoin::deploy {

/// A parameter from 1 to 9.
inline ParameterInfo parameter(std::string name, std::string default_value, std::string unit = "") {
  ParameterInfo info;
  info.name = std::move(name);
  info.type = ParameterType::real;
  info.unit = std::move(unit);
  info.default_value = std::move(default_value);
  info.minimum = 1.0;
  info.maximum = 9.0;
  info.description = "what it does";
  return info;
}

/// Two methods with a parameter in common and one of the same name with different defaults.
inline KindInfo kind_of_two_methods() {
  KindInfo kind;
  kind.name = "cutting";
  kind.description = "cuts scans";
  kind.program = "quoin-cutting";
  kind.inputs = {{"scan", "scan"}};
  kind.outputs = {{"segments"}};
  kind.methods = {{"saw",
                   "cuts slowly",
                   "Smith 1900",
                   "For wood.",
                   {parameter("depth", "2", "m"), parameter("teeth", "3")}},
                  {"laser",
                   "cuts fast",
                   "Jones 2000",
                   "For steel.",
                   {parameter("teeth", "4"), parameter("depth", "2", "m"),
                    parameter("angle", "1.5707963267948966", "rad")}}};
  return kind;
}

}  // namespace quoin::deploy
