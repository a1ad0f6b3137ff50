// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "deploy/evaluation/methods/parameter_text.hpp"

#include <cmath>

namespace quoin::deploy {

std::string type_name(ParameterType type) {
  switch (type) {
    case ParameterType::boolean:
      return "boolean";
    case ParameterType::integer:
      return "integer";
    case ParameterType::real:
      return "real";
    case ParameterType::choice:
      return "choice";
    case ParameterType::text:
      return "text";
  }
  return "unknown";
}

std::string range_text(const ParameterInfo& info) {
  if (info.type == ParameterType::choice) {
    std::string text;
    for (const std::string& choice : info.choices) text += (text.empty() ? "" : " or ") + choice;
    return text;
  }
  if (!std::isfinite(info.minimum) && !std::isfinite(info.maximum)) return type_name(info.type);
  const auto limit = [](double value) {
    return std::isfinite(value) ? detail::number_text(value) : std::string();
  };
  return type_name(info.type) + " " + limit(info.minimum) + ".." + limit(info.maximum);
}

std::string default_text(const ParameterInfo& info) {
  return info.default_value.empty() ? "''" : info.default_value;
}

}  // namespace quoin::deploy
