// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/deployment/environment.hpp"

#include <cstddef>
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

namespace {

constexpr std::size_t longest_value = 4096;  // [byte] of a path
constexpr int deepest_default = 8;

/// Where the } is that belongs to the ${ before `position`.
std::size_t end_of_variable(const std::string& text, std::size_t position) {
  for (int depth = 1; position < text.size(); ++position) {
    if (text.compare(position, 2, "${") == 0) {
      ++depth;
    } else if (text[position] == '}' && --depth == 0) {
      return position;
    }
  }
  throw std::invalid_argument("'${' without '}'; write ${NAME} or ${NAME:-default}");
}

std::string replaced(const std::string& text, const Lookup& lookup, int depth);

std::string value_of(const std::string& inside, const Lookup& lookup, int depth) {
  const std::size_t separator = inside.find(":-");
  const std::string name = inside.substr(0, separator);
  if (!is_variable_name(name)) {
    throw std::invalid_argument("'" + name +
                                "' is no name of a variable; write ${NAME} or ${NAME:-default}");
  }
  const std::optional<std::string> value = lookup(name);
  if (separator != std::string::npos) {
    if (value && !value->empty()) return *value;
    return replaced(inside.substr(separator + 2), lookup, depth + 1);
  }
  if (value) return *value;
  throw std::invalid_argument("the environment variable " + name +
                              " is not set; set it or write ${" + name + ":-default}");
}

std::string replaced(const std::string& text, const Lookup& lookup, int depth) {
  if (depth > deepest_default) throw std::invalid_argument("defaults are nested too deeply");
  std::string result;
  std::size_t position = 0;
  while (true) {
    const std::size_t start = text.find("${", position);
    result.append(text, position, start - position);
    if (start == std::string::npos) return result;
    const std::size_t end = end_of_variable(text, start + 2);
    result += value_of(text.substr(start + 2, end - start - 2), lookup, depth);
    if (result.size() > longest_value) {
      throw std::invalid_argument("longer than " + std::to_string(longest_value) +
                                  " bytes with the values of its variables");
    }
    position = end + 1;
  }
}

}  // namespace

std::string replace_variables(const std::string& text, const Lookup& lookup) {
  return replaced(text, lookup, 0);
}

}  // namespace quoin
