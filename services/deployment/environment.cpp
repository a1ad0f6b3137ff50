// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/deployment/environment.hpp"

#include <cstdlib>
#include <stdexcept>

namespace quoin {

namespace {
bool is_variable_name(const std::string& name) {
  constexpr auto letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz_0123456789";
  return !name.empty() && name.find_first_not_of(letters) == std::string::npos &&
         (name.front() < '0' || name.front() > '9');
}
}  // namespace

std::optional<std::string> environment_variable(const std::string& name) {
  const char* value = std::getenv(name.c_str());
  if (value == nullptr) return std::nullopt;
  return std::string(value);
}

std::string replace_variables(const std::string& text, const Lookup& lookup) {
  std::string result;
  std::size_t position = 0;
  while (true) {
    const std::size_t start = text.find("${", position);
    result += text.substr(position, start - position);
    if (start == std::string::npos) return result;
    const std::size_t end = text.find('}', start);
    if (end == std::string::npos) {
      throw std::invalid_argument("'${' without '}'; write ${NAME} or ${NAME:-default}");
    }
    const std::string inside = text.substr(start + 2, end - start - 2);
    const std::size_t separator = inside.find(":-");
    const std::string name = inside.substr(0, separator);
    if (!is_variable_name(name)) {
      throw std::invalid_argument("'" + name +
                                  "' is no name of a variable; write ${NAME} or ${NAME:-default}");
    }
    const std::optional<std::string> value = lookup(name);
    if (separator != std::string::npos) {
      result += value && !value->empty() ? *value : inside.substr(separator + 2);
    } else if (value) {
      result += *value;
    } else {
      throw std::invalid_argument("the environment variable " + name +
                                  " is not set; set it or write ${" + name + ":-default}");
    }
    position = end + 1;
  }
}

}  // namespace quoin
