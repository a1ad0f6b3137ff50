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

std::string join_name(Join join) {
  switch (join) {
    case Join::each:
      return "each";
    case Join::latest:
      return "latest";
    case Join::by_time:
      return "by_time";
  }
  return "unknown";
}

Json inputs_json(const KindInfo& kind) {
  Json inputs = Json::array();
  for (const InputPort& port : kind.inputs) {
    inputs.push_back({{"port", port.name},
                      {"type", port.type},
                      {"join", join_name(port.join)},
                      {"required", port.required}});
  }
  return inputs;
}

Json outputs_json(const KindInfo& kind) {
  Json outputs = Json::array();
  for (const OutputPort& port : kind.outputs) {
    outputs.push_back(
        {{"type", port.type}, {"rate", port.rate == Rate::per_input ? "per_input" : "own_rate"}});
  }
  return outputs;
}

}  // namespace

std::string ports_text(const KindInfo& kind) {
  std::string outputs;
  for (const OutputPort& port : kind.outputs) {
    outputs += (outputs.empty() ? "" : " and ") + port.type;
  }
  if (!kind.reads()) return outputs.empty() ? "publishes nothing" : "source of " + outputs;
  std::string inputs;
  for (const InputPort& port : kind.inputs) {
    inputs += (inputs.empty() ? "" : ", ") + port.type;
    if (kind.inputs.size() == 1) continue;
    inputs +=
        " (" + port.name + ": " + join_name(port.join) + (port.required ? ")" : ", optional)");
  }
  if (kind.observer) inputs = "any messages";
  return "reads " + inputs + ", publishes " + (outputs.empty() ? "nothing" : outputs);
}

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
          {"input", kind.inputs.empty() ? "none" : kind.inputs.front().type},
          {"output", kind.outputs.empty() ? "none" : kind.outputs.front().type},
          {"inputs", inputs_json(kind)},
          {"outputs", outputs_json(kind)},
          {"methods", methods},
          {"parameters", parameters_json(kind.parameters)}};
}

std::string description_text(const KindInfo& kind) {
  std::ostringstream out;
  out << kind.name << ": " << kind.description << "\n  ";
  out << ports_text(kind) << '\n';
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
