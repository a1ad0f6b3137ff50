// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/deployment/kind.hpp"

#include <algorithm>
#include <stdexcept>

namespace quoin {

namespace {

template <class Port>
const Port* find_port(const std::vector<Port>& ports, std::string Port::*key,
                      std::string_view value) {
  const auto found = std::find_if(ports.begin(), ports.end(),
                                  [&](const Port& port) { return port.*key == value; });
  return found == ports.end() ? nullptr : &*found;
}

}  // namespace

const InputPort* KindInfo::input(std::string_view port) const {
  return find_port(inputs, &InputPort::name, port);
}

const OutputPort* KindInfo::output(std::string_view type) const {
  return find_port(outputs, &OutputPort::type, type);
}

bool KindInfo::gives(const OutputPort& port, const ParameterSettings& settings) const {
  if (port.parameter.empty()) return true;
  const auto info = std::ranges::find(parameters, port.parameter, &ParameterInfo::name);
  if (info == parameters.end()) throw std::logic_error("no parameter " + port.parameter);
  const auto setting = std::ranges::find(settings, port.parameter, &ParameterSetting::name);
  const std::string& value = setting == settings.end() ? info->default_value : setting->text;
  // A switch is true, or a list of types names this one. What is neither true nor false has been
  // reported.
  if (info->type == ParameterType::boolean) return value == "true";
  return std::ranges::count(list_entries(value), port.type) > 0;
}

const KindInfo* KindList::find(std::string_view name) const {
  for (const KindInfo* kind : kinds) {
    if (kind->name == name) return kind;
  }
  return name == external_kind().name ? &external_kind() : nullptr;
}

const KindInfo& external_kind() {
  static const KindInfo kind{
      .name = "external",
      .description =
          "messages of a program that is no service of this project, on a topic of its own"};
  return kind;
}

const std::vector<ParameterInfo>& parameters_of(const KindInfo& kind, std::string_view method) {
  if (kind.methods.empty()) return kind.parameters;
  for (const MethodInfo& info : kind.methods) {
    if (info.name == method) return info.parameters;
  }
  throw std::out_of_range("no method '" + std::string(method) + "' of " + kind.name);
}

}  // namespace quoin
