// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "deploy/evaluation/methods/description.hpp"

#include <cmath>
#include <sstream>

#include <nlohmann/json.hpp>

#include "deploy/evaluation/methods/parameter_text.hpp"

namespace quoin::deploy {

namespace {

using Json = nlohmann::ordered_json;

Json parameters_json(const std::vector<ParameterInfo>& parameters) {
  Json list = Json::array();
  for (const ParameterInfo& info : parameters) {
    Json object{{"name", info.name},         {"type", type_name(info.type)},
                {"unit", info.unit},         {"default", info.default_value},
                {"required", info.required}, {"description", info.description}};
    if (std::isfinite(info.minimum)) object["minimum"] = info.minimum;
    if (std::isfinite(info.maximum)) object["maximum"] = info.maximum;
    if (!info.choices.empty()) object["choices"] = info.choices;
    list.push_back(object);
  }
  return list;
}

void print(std::ostream& out, const std::vector<ParameterInfo>& parameters,
           const std::string& indent) {
  for (const ParameterInfo& info : parameters) {
    out << indent << info.name;
    if (!info.required) out << " = " << default_text(info);
    if (!info.unit.empty()) out << ' ' << info.unit;
    out << "  (" << range_text(info) << (info.required ? ", required" : "") << ")\n"
        << indent << "    " << info.description << '\n';
  }
}

}  // namespace

Json description_json(const KindInfo& kind) {
  Json methods = Json::array();
  for (const MethodInfo& method : kind.methods) {
    methods.push_back({{"name", method.name},
                       {"description", method.description},
                       {"source", method.source},
                       {"choose", method.choose},
                       {"parameters", parameters_json(method.parameters)}});
  }
  return {{"kind", kind.name},
          {"description", kind.description},
          {"program", kind.program},
          {"input", message_name(kind.input)},
          {"output", message_name(kind.output)},
          {"qos", kind.qos},
          {"methods", methods},
          {"parameters", parameters_json(kind.parameters)}};
}

std::string description_text(const KindInfo& kind) {
  std::ostringstream out;
  out << kind.name << ": " << kind.description << "\n  ";
  if (kind.input == MessageType::none) {
    out << "source of " << message_name(kind.output) << '\n';
  } else {
    out << "reads " << message_name(kind.input) << ", publishes " << message_name(kind.output)
        << '\n';
  }
  print(out, kind.parameters, "    ");
  for (const MethodInfo& method : kind.methods) {
    out << "  " << method.name << (&method == &kind.methods.front() ? " (default)" : "") << ": "
        << method.description << "\n    source: " << method.source
        << "\n    choose: " << method.choose << '\n';
    print(out, method.parameters, "      ");
  }
  return out.str();
}

}  // namespace quoin::deploy
