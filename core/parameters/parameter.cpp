// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/parameters/parameter.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <numeric>
#include <span>
#include <system_error>
#include <utility>

namespace quoin {
namespace {

/// Damerau-Levenshtein distance in its optimal string alignment form: insertions, deletions,
/// replacements and swaps of neighbours cost 1 each.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before_last(b.size() + 1), last(b.size() + 1), current(b.size() + 1);
  std::iota(last.begin(), last.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    current[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replacement = last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      current[j] = std::min({replacement, last[j] + 1, current[j - 1] + 1});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) {
        current[j] = std::min(current[j], before_last[j - 2] + 1);
      }
    }
    std::swap(before_last, last);
    std::swap(last, current);
  }
  return last[b.size()];
}

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
  std::array<UnitSuffix, 5> suffixes;
};

constexpr std::array<Quantity, 7> quantities{{
    {"m", "a length", "m, cm or mm", {{{"m", 1.0}, {"cm", 1e-2}, {"mm", 1e-3}, {"um", 1e-6}, {}}}},
    {"rad",
     "an angle",
     "rad, mrad or deg",
     {{{"rad", 1.0}, {"mrad", 1e-3}, {"deg", radians_per_degree}, {}, {}}}},
    {"s",
     "a time",
     "s, ms, us, min or h",
     {{{"s", 1.0}, {"ms", 1e-3}, {"us", 1e-6}, {"min", 60.0}, {"h", 3600.0}}}},
    {"Hz", "a frequency", "Hz or kHz", {{{"Hz", 1.0}, {"kHz", 1e3}, {}, {}, {}}}},
    {"m/m", "a share", "%, mm/m or m/m", {{{"m/m", 1.0}, {"%", 1e-2}, {"mm/m", 1e-3}, {}, {}}}},
    {"m/s",
     "a speed",
     "m/s, cm/s, mm/s or km/h",
     {{{"m/s", 1.0}, {"cm/s", 1e-2}, {"mm/s", 1e-3}, {"km/h", 1.0 / 3.6}, {}}}},
    {"rad/s",
     "an angular speed",
     "rad/s or deg/s",
     {{{"rad/s", 1.0}, {"deg/s", radians_per_degree}, {}, {}, {}}}},
}};

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view blanks = " \t\r\n";
  const std::size_t first = text.find_first_not_of(blanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

/// What from_chars reads: without a leading plus.
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

std::string setting_or_default(const ParameterInfo& info, const ParameterSettings& settings) {
  for (const ParameterSetting& setting : settings) {
    if (setting.name == info.name) return setting.text;
  }
  return info.default_value;
}

bool same_value(const ParameterInfo& info, const std::string& a, const std::string& b) {
  if (a == b) return true;
  try {
    if (info.type == ParameterType::real) {
      const double first = detail::parse_real(info, a);
      const double second = detail::parse_real(info, b);
      // One number in two units differs by rounding.
      return std::abs(first - second) <= 1e-12 * std::max(std::abs(first), std::abs(second));
    }
    if (info.type == ParameterType::integer) {
      return detail::parse_integer(info, a) == detail::parse_integer(info, b);
    }
  } catch (const ParameterError&) {
    return false;  // a default may lie where no setting can
  }
  return false;
}

}  // namespace

std::string nearest_name(std::string_view name, const std::vector<std::string>& candidates) {
  std::string nearest;
  std::size_t nearest_distance = 0;
  for (const std::string& candidate : candidates) {
    const std::size_t distance = edit_distance(name, candidate);
    // One slip per three letters: more is another word.
    const std::size_t allowed =
        std::max<std::size_t>(1, std::max(name.size(), candidate.size()) / 3);
    const bool shares_a_letter = distance < std::max(name.size(), candidate.size());
    if (distance <= allowed && shares_a_letter &&
        (nearest.empty() || distance < nearest_distance)) {
      nearest = candidate;
      nearest_distance = distance;
    }
  }
  return nearest;
}

std::string suggestion(std::string_view name, const std::vector<std::string>& candidates) {
  const std::string nearest = nearest_name(name, candidates);
  if (!nearest.empty()) return "; did you mean '" + nearest + "'?";
  if (candidates.empty()) return "";
  std::string text = "; known are ";
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    if (i > 0) text += ", ";
    text += candidates[i];
  }
  return text;
}

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
  // A suffix is % or starts with a letter; anything else is a number that goes on wrongly, such as
  // 1.2.3.
  const bool is_unit = suffix.empty() || suffix == "%" || (suffix[0] >= 'a' && suffix[0] <= 'z') ||
                       (suffix[0] >= 'A' && suffix[0] <= 'Z');
  if (!is_unit) fail(info, quoted(value) + " is not a number");
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

ParameterSettings changed_settings(const std::vector<ParameterInfo>& infos,
                                   const ParameterSettings& from, const ParameterSettings& to) {
  ParameterSettings changed;
  for (const ParameterInfo& info : infos) {
    const std::string text = setting_or_default(info, to);
    if (!same_value(info, setting_or_default(info, from), text)) {
      changed.push_back({info.name, text});
    }
  }
  return changed;
}

std::vector<std::string> list_entries(std::string_view text) {
  std::vector<std::string> entries;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    const std::size_t first = text.find_first_not_of(' ', begin);
    if (first < end) {
      const std::size_t last = text.find_last_not_of(' ', end - 1);
      entries.emplace_back(text.substr(first, last - first + 1));
    }
    begin = end + 1;
  }
  return entries;
}

}  // namespace quoin
