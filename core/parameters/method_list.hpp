// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/parameters/parameter.hpp"

namespace quoin {

/// Description of a method, for users.
struct MethodInfo {
  std::string name;
  std::string description;
  std::string source;  ///< publication it comes from
  std::string choose;  ///< when to choose it, and when not
  std::vector<ParameterInfo> parameters;
  /// Name and version of the form of what it keeps from message to message, such as "line_map/1";
  /// "" when it keeps nothing. What has the same can go on where the other one ended.
  std::string state = {};
};

/// The methods of one concept (segmenters, fitters, corner finders), the first being the default. A
/// method is a class with `name`, `description`, `source`, `choose`, a nested `Parameters` struct
/// and a constructor from it; one that keeps something from message to message has `state`, too.
/// Adding one is one more name in the list.
///
/// `descriptions` uses the headers only, so that a program that only describes methods links none
/// of them.
template <class... Methods>
struct MethodList {
  [[nodiscard]] static std::vector<MethodInfo> descriptions() {
    return {MethodInfo{Methods::name, Methods::description, Methods::source, Methods::choose,
                       describe_parameters<typename Methods::Parameters>(),
                       state_of<Methods>()}...};
  }

  /// The named method with `settings` applied, as a `Function` (a std::function that it can be
  /// called as). Throws ParameterError when the name or a setting is wrong.
  template <class Function>
  [[nodiscard]] static Function make(std::string_view name, const ParameterSettings& settings) {
    Function function;
    const bool found = (try_make<Methods>(name, settings, function) || ...);
    if (!found) {
      throw ParameterError("method", "unknown method '" + std::string(name) + "'" +
                                         suggestion(name, {Methods::name...}));
    }
    return function;
  }

  /// The value in force of one parameter, as text: what `settings` say, or the method's default; ""
  /// when the method has no such parameter.
  [[nodiscard]] static std::string setting(std::string_view name, const ParameterSettings& settings,
                                           std::string_view parameter) {
    for (const ParameterSetting& setting : settings) {
      if (setting.name == parameter) return setting.text;
    }
    for (const MethodInfo& method : descriptions()) {
      if (method.name != name) continue;
      for (const ParameterInfo& info : method.parameters) {
        if (info.name == parameter) return info.default_value;
      }
    }
    return "";
  }

 private:
  template <class Method>
  [[nodiscard]] static std::string state_of() {
    if constexpr (requires { Method::state; }) {
      return Method::state;
    } else {
      return "";
    }
  }

  template <class Method, class Function>
  static bool try_make(std::string_view name, const ParameterSettings& settings,
                       Function& function) {
    if (name != Method::name) return false;
    function = Method(make_parameters<typename Method::Parameters>(settings));
    return true;
  }
};

}  // namespace quoin
