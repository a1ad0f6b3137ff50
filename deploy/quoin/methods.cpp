// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "deploy/deployment/kinds.hpp"
#include "deploy/quoin/commands.hpp"

namespace quoin::deploy {

namespace {

using Json = nlohmann::ordered_json;

struct MethodsOptions {
  std::string kind;
  bool json = false;
};

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

Json describe(const std::vector<ParameterInfo>& parameters) {
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

Json describe(const KindInfo& kind) {
  Json methods = Json::array();
  for (const MethodInfo& method : kind.methods) {
    methods.push_back({{"name", method.name},
                       {"description", method.description},
                       {"source", method.source},
                       {"parameters", describe(method.parameters)}});
  }
  return {{"kind", kind.name},
          {"description", kind.description},
          {"program", kind.program},
          {"input", message_name(kind.input)},
          {"output", message_name(kind.output)},
          {"qos", kind.qos},
          {"methods", methods},
          {"parameters", describe(kind.parameters)}};
}

std::string range_text(const ParameterInfo& info) {
  if (info.type == ParameterType::choice) {
    std::string text;
    for (const std::string& choice : info.choices) text += (text.empty() ? "" : " | ") + choice;
    return text;
  }
  if (!std::isfinite(info.minimum) && !std::isfinite(info.maximum)) return type_name(info.type);
  const auto limit = [](double value) {
    return std::isfinite(value) ? detail::number_text(value) : std::string();
  };
  return type_name(info.type) + " " + limit(info.minimum) + ".." + limit(info.maximum);
}

void print(const std::vector<ParameterInfo>& parameters, const std::string& indent) {
  for (const ParameterInfo& info : parameters) {
    std::cout << indent << info.name;
    if (!info.required) {
      std::cout << " = " << (info.default_value.empty() ? "''" : info.default_value);
    }
    if (!info.unit.empty()) std::cout << ' ' << info.unit;
    std::cout << "  (" << range_text(info) << (info.required ? ", required" : "") << ")\n"
              << indent << "    " << info.description << '\n';
  }
}

void print(const KindInfo& kind) {
  std::cout << kind.name << ": " << kind.description << "\n  ";
  if (kind.input == MessageType::none) {
    std::cout << "source of " << message_name(kind.output) << '\n';
  } else {
    std::cout << "reads " << message_name(kind.input) << ", publishes " << message_name(kind.output)
              << '\n';
  }
  print(kind.parameters, "    ");
  for (const MethodInfo& method : kind.methods) {
    std::cout << "  " << method.name << (&method == &kind.methods.front() ? " (default)" : "")
              << ": " << method.description << "\n    source: " << method.source << '\n';
    print(method.parameters, "      ");
  }
}

int run(const MethodsOptions& options) {
  Json list = Json::array();
  std::vector<std::string> names;
  bool found = false;
  for (const KindInfo& kind : kinds()) {
    names.push_back(kind.name);
    if (!options.kind.empty() && options.kind != kind.name) continue;
    if (options.json) {
      list.push_back(describe(kind));
    } else {
      if (found) std::cout << '\n';
      print(kind);
    }
    found = true;
  }
  if (!found) {
    std::cerr << "unknown kind '" << options.kind << "'" << suggestion(options.kind, names) << '\n';
    return exit_configuration;
  }
  if (options.json) std::cout << list.dump(2) << '\n';
  return exit_ok;
}

}  // namespace

Command add_methods(CLI::App& app) {
  CLI::App* line =
      app.add_subcommand("methods", "List the kinds of services, their methods and parameters");
  const auto options = std::make_shared<MethodsOptions>();
  line->add_option("kind", options->kind, "Only this kind");
  line->add_flag("--json", options->json, "As a JSON array");
  return {line, [options] { return run(*options); }};
}

}  // namespace quoin::deploy
