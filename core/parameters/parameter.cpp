// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/parameters/parameter.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <span>
#include <system_error>

#include "core/parameters/suggestion.hpp"

namespace quoin {
namespace {

constexpr double radians_per_degree = 3.14159265358979323846 / 180.0;

struct UnitSuffix {
  std::string_view text;
  double to_si;
};

/// Suffixes that may follow a number whose SI unit is `si`.
struct Quantity {
  std::string_view si;
  std::string_view name;   ///< with its article
  std::string_view units;  ///< as an error text lists them
  std::array<UnitSuffix, 4> suffixes;
};

constexpr std::array<Quantity, 6> quantities{{
    {"m", "a length", "m, cm or mm", {{{"m", 1.0}, {"cm", 1e-2}, {"mm", 1e-3}, {"um", 1e-6}}}},
    {"rad",
     "an angle",
     "rad, mrad or deg",
     {{{"rad", 1.0}, {"mrad", 1e-3}, {"deg", radians_per_degree}, {}}}},
    {"s", "a time", "s, ms, us or min", {{{"s", 1.0}, {"ms", 1e-3}, {"us", 1e-6}, {"min", 60.0}}}},
    {"Hz", "a frequency", "Hz or kHz", {{{"Hz", 1.0}, {"kHz", 1e3}, {}, {}}}},
    {"m/s", "a speed", "m/s or mm/s", {{{"m/s", 1.0}, {"mm/s", 1e-3}, {}, {}}}},
    {"rad/s",
     "an angular speed",
     "rad/s or deg/s",
     {{{"rad/s", 1.0}, {"deg/s", radians_per_degree}, {}, {}}}},
}};

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view blanks = " \t\r\n";
  const std::size_t first = text.find_first_not_of(blanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

/// What from_chars is to read: it knows no leading plus.
std::string_view without_plus(std::string_view text) {
  const bool plus = text.size() > 1 && text[0] == '+' && text[1] != '-' && text[1] != '+';
  return plus ? text.substr(1) : text;
}

[[noreturn]] void fail(const ParameterInfo& info, const std::string& what) {
  throw ParameterError(info.name, what);
}

std::string quoted(std::string_view text) {
  std::string result(1, '\'');
  result.append(text);
  result.push_back('\'');
  return result;
}

/// The factor from the written unit to the SI unit of `info`.
double unit_factor(const ParameterInfo& info, std::string_view suffix) {
  if (suffix.empty()) return 1.0;
  for (const Quantity& quantity : quantities) {
    if (quantity.si != info.unit) continue;
    for (const UnitSuffix& unit : quantity.suffixes) {
      if (!unit.text.empty() && unit.text == suffix) return unit.to_si;
    }
    fail(info, "unit " + quoted(suffix) + " is not " + std::string(quantity.name) + "; write " +
                   std::string(quantity.units));
  }
  if (!info.unit.empty() && suffix == info.unit) return 1.0;
  if (info.unit.empty()) fail(info, "a number without a unit is needed, not " + quoted(suffix));
  fail(info, "unit " + quoted(suffix) + " is not known; write " + info.unit);
}

void check_limits(const ParameterInfo& info, double value, std::string_view text) {
  if (value >= info.minimum && value <= info.maximum) return;
  const std::string unit = info.unit.empty() ? "" : " " + info.unit;
  const std::string minimum = detail::number_text(info.minimum);
  const std::string maximum = detail::number_text(info.maximum);
  if (std::isinf(info.maximum)) fail(info, std::string(text) + " is less than " + minimum + unit);
  if (std::isinf(info.minimum)) fail(info, std::string(text) + " is more than " + maximum + unit);
  fail(info, std::string(text) + " is outside " + minimum + ".." + maximum + unit);
}

}  // namespace

namespace detail {

bool parse_boolean(const ParameterInfo& info, const std::string& text) {
  const std::string_view value = trimmed(text);
  if (value == "true") return true;
  if (value == "false") return false;
  fail(info, quoted(value) + " is neither true nor false");
}

std::int64_t parse_integer(const ParameterInfo& info, const std::string& text) {
  const std::string_view value = trimmed(text);
  const std::string_view digits = without_plus(value);
  std::int64_t number = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
  if (error != std::errc{} || end != digits.data() + digits.size()) {
    fail(info, quoted(value) + " is not a whole number");
  }
  check_limits(info, static_cast<double>(number), value);
  return number;
}

double parse_real(const ParameterInfo& info, const std::string& text) {
  const std::string_view value = trimmed(text);
  const std::string_view digits = without_plus(value);
  double number = 0.0;
  const char* const last = digits.data() + digits.size();
  const auto [end, error] = std::from_chars(digits.data(), last, number);
  if (error != std::errc{} || !std::isfinite(number))
    fail(info, quoted(value) + " is not a number");
  const std::string_view suffix = trimmed({end, static_cast<std::size_t>(last - end)});
  // A suffix starts with a letter; anything else is a number that goes on wrongly, such as 1.2.3.
  const bool starts_with_letter = suffix.empty() || (suffix[0] >= 'a' && suffix[0] <= 'z') ||
                                  (suffix[0] >= 'A' && suffix[0] <= 'Z');
  if (!starts_with_letter) fail(info, quoted(value) + " is not a number");
  number *= unit_factor(info, suffix);
  check_limits(info, number, value);
  return number;
}

std::size_t parse_choice(const ParameterInfo& info, const std::string& text) {
  const std::string_view value = trimmed(text);
  for (std::size_t i = 0; i < info.choices.size(); ++i) {
    if (value == info.choices[i]) return i;
  }
  fail(info, quoted(value) + " is not a choice" + suggestion(value, info.choices));
}

std::string number_text(double value) {
  // Shortest text that reads back as the same double; 32 characters hold every double. Whole
  // numbers are written out: 100000 rather than 1e+05.
  std::array<char, 32> buffer{};
  if (std::abs(value) < 1e15 && value == std::floor(value)) {
    const auto whole = std::to_chars(buffer.data(), buffer.data() + buffer.size(),
                                     static_cast<std::int64_t>(value));
    return {buffer.data(), whole.ptr};
  }
  const auto result = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
  return {buffer.data(), result.ptr};
}

}  // namespace detail

void check_parameter(const ParameterInfo& info, const std::string& text) {
  switch (info.type) {
    case ParameterType::boolean:
      detail::parse_boolean(info, text);
      break;
    case ParameterType::integer:
      detail::parse_integer(info, text);
      break;
    case ParameterType::real:
      detail::parse_real(info, text);
      break;
    case ParameterType::choice:
      detail::parse_choice(info, text);
      break;
    case ParameterType::text:
      break;
  }
}

void check_parameters(const std::vector<ParameterInfo>& infos, const ParameterSettings& settings) {
  for (const ParameterSetting& setting : settings) {
    const ParameterInfo* known = nullptr;
    std::vector<std::string> names;
    for (const ParameterInfo& info : infos) {
      if (info.name == setting.name) known = &info;
      names.push_back(info.name);
    }
    if (known == nullptr) {
      throw ParameterError(setting.name, "unknown parameter " + quoted(setting.name) +
                                             suggestion(setting.name, names));
    }
    check_parameter(*known, setting.text);
  }
}

void check_required(const std::vector<ParameterInfo>& infos, const ParameterSettings& settings) {
  for (const ParameterInfo& info : infos) {
    const bool given = std::any_of(settings.begin(), settings.end(), [&](const auto& setting) {
      return setting.name == info.name && !setting.text.empty();
    });
    if (info.required && !given) {
      throw ParameterError(info.name, "is missing: " + info.description);
    }
  }
}

}  // namespace quoin
