// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

namespace quoin {

/// The candidate nearest to `name` by edit distance (a swap of neighbours counts once), or "" when
/// none is near enough to be what was meant.
[[nodiscard]] std::string nearest_name(std::string_view name,
                                       const std::vector<std::string>& candidates);

/// "; did you mean 'x'?" when some candidate is near, else "; known are a, b, c".
[[nodiscard]] std::string suggestion(std::string_view name,
                                     const std::vector<std::string>& candidates);

/// A parameter as the user wrote it: the text of the value, with or without a unit.
struct ParameterSetting {
  std::string name;
  std::string text;

  friend bool operator==(const ParameterSetting&, const ParameterSetting&) = default;
};
using ParameterSettings = std::vector<ParameterSetting>;

enum class ParameterType { boolean, integer, real, choice, text };

/// Description of a parameter, for users. Made from the one description beside the struct
/// that holds the value (see `field`), never written by hand.
struct ParameterInfo {
  std::string name;
  ParameterType type = ParameterType::text;
  std::string unit;           ///< SI unit of the stored value, "" when it has none
  std::string default_value;  ///< as text, in the SI unit
  double minimum = -std::numeric_limits<double>::infinity();
  double maximum = std::numeric_limits<double>::infinity();
  std::vector<std::string> choices;  ///< for ParameterType::choice
  bool required = false;             ///< has no default that could be used
  std::string description;

  friend bool operator==(const ParameterInfo&, const ParameterInfo&) = default;
};

/// The entries of a parameter that is a list with commas, without blanks around them; empty ones
/// are left out.
[[nodiscard]] std::vector<std::string> list_entries(std::string_view text);

/// A setting that cannot be used: which parameter, what is wrong, what to do.
class ParameterError : public std::invalid_argument {
 public:
  ParameterError(std::string parameter, const std::string& what)
      : std::invalid_argument(what), parameter_(std::move(parameter)) {}
  [[nodiscard]] const std::string& parameter() const { return parameter_; }

 private:
  std::string parameter_;
};

/// Names of an enumeration's values; specialise with
/// `static constexpr std::array<std::pair<E, std::string_view>, N> names`.
template <class E>
struct EnumNames;

template <class E>
[[nodiscard]] constexpr std::string_view enum_name(E value) {
  for (const auto& [candidate, name] : EnumNames<E>::names) {
    if (candidate == value) return name;
  }
  return "unknown";
}

/// Description of one member of a parameter struct.
template <class Owner, class T>
struct ParameterField {
  using Value = T;
  T Owner::*member;
  const char* name;
  const char* unit;
  double minimum;
  double maximum;
  const char* description;
  bool required = false;
};

inline constexpr double no_limit = std::numeric_limits<double>::infinity();

/// A number with its SI unit and its allowed range, both ends included.
template <class Owner, class T>
constexpr ParameterField<Owner, T> field(T Owner::*member, const char* name, const char* unit,
                                         double minimum, double maximum, const char* description) {
  return {member, name, unit, minimum, maximum, description};
}

/// A text without which nothing works.
template <class Owner>
constexpr ParameterField<Owner, std::string> required_field(std::string Owner::*member,
                                                            const char* name,
                                                            const char* description) {
  return {member, name, "", -no_limit, no_limit, description, true};
}

/// A switch, a choice or a text.
template <class Owner, class T>
constexpr ParameterField<Owner, T> field(T Owner::*member, const char* name,
                                         const char* description) {
  return {member, name, "", -no_limit, no_limit, description};
}

/// Throws ParameterError when `text` is not a value for `info`. Used where only the description is
/// at hand, such as by the deployment reader.
void check_parameter(const ParameterInfo& info, const std::string& text);

/// Throws ParameterError for the first setting that `infos` does not know (with the nearest name)
/// or whose value is wrong.
void check_parameters(const std::vector<ParameterInfo>& infos, const ParameterSettings& settings);

/// Throws ParameterError for the first required parameter that is not among `settings`.
void check_required(const std::vector<ParameterInfo>& infos, const ParameterSettings& settings);

namespace detail {
// The text of a setting as a value inside the limits of `info`; all throw ParameterError.
bool parse_boolean(const ParameterInfo& info, const std::string& text);
std::int64_t parse_integer(const ParameterInfo& info, const std::string& text);
double parse_real(const ParameterInfo& info, const std::string& text);
std::size_t parse_choice(const ParameterInfo& info, const std::string& text);
std::string number_text(double value);

template <class T>
constexpr ParameterType parameter_type() {
  if constexpr (std::is_same_v<T, bool>) {
    return ParameterType::boolean;
  } else if constexpr (std::is_enum_v<T>) {
    return ParameterType::choice;
  } else if constexpr (std::is_integral_v<T>) {
    return ParameterType::integer;
  } else if constexpr (std::is_floating_point_v<T>) {
    return ParameterType::real;
  } else {
    static_assert(std::is_same_v<T, std::string>,
                  "parameters are bool, integers, double, enum or string");
    return ParameterType::text;
  }
}

template <class T>
std::string value_text(const T& value) {
  if constexpr (std::is_same_v<T, bool>) {
    return value ? "true" : "false";
  } else if constexpr (std::is_enum_v<T>) {
    return std::string(enum_name(value));
  } else if constexpr (std::is_integral_v<T>) {
    return std::to_string(value);
  } else if constexpr (std::is_floating_point_v<T>) {
    return number_text(value);
  } else {
    return value;
  }
}

template <class Owner, class T>
ParameterInfo describe_field(const ParameterField<Owner, T>& f, const Owner& defaults) {
  ParameterInfo info;
  info.name = f.name;
  info.type = parameter_type<T>();
  info.unit = f.unit;
  info.default_value = value_text(defaults.*(f.member));
  info.minimum = f.minimum;
  info.maximum = f.maximum;
  info.description = f.description;
  info.required = f.required;
  if constexpr (std::is_enum_v<T>) {
    for (const auto& [value, name] : EnumNames<T>::names) info.choices.emplace_back(name);
  }
  return info;
}

template <class Owner, class T>
void assign_field(const ParameterField<Owner, T>& f, Owner& owner, const std::string& text) {
  const ParameterInfo info = describe_field(f, Owner{});
  if constexpr (std::is_same_v<T, bool>) {
    owner.*(f.member) = parse_boolean(info, text);
  } else if constexpr (std::is_enum_v<T>) {
    owner.*(f.member) = EnumNames<T>::names[parse_choice(info, text)].first;
  } else if constexpr (std::is_integral_v<T>) {
    owner.*(f.member) = static_cast<T>(parse_integer(info, text));
  } else if constexpr (std::is_floating_point_v<T>) {
    owner.*(f.member) = static_cast<T>(parse_real(info, text));
  } else {
    owner.*(f.member) = text;
  }
}
}  // namespace detail

/// The parameters of a struct that has `static constexpr auto fields()` returning a tuple of
/// `field`s.
template <class P>
[[nodiscard]] std::vector<ParameterInfo> describe_parameters() {
  std::vector<ParameterInfo> infos;
  const P defaults{};
  std::apply([&](const auto&... f) { (infos.push_back(detail::describe_field(f, defaults)), ...); },
             P::fields());
  return infos;
}

/// The struct with `settings` applied to its defaults. Throws ParameterError.
template <class P>
[[nodiscard]] P make_parameters(const ParameterSettings& settings) {
  const std::vector<ParameterInfo> infos = describe_parameters<P>();
  check_parameters(infos, settings);
  check_required(infos, settings);
  P parameters{};
  for (const ParameterSetting& setting : settings) {
    std::apply(
        [&](const auto&... f) {
          ((setting.name == f.name ? detail::assign_field(f, parameters, setting.text) : void()),
           ...);
        },
        P::fields());
  }
  return parameters;
}

/// The values in force, as text in SI units, in the order of the fields.
template <class P>
[[nodiscard]] ParameterSettings parameter_settings(const P& parameters) {
  ParameterSettings settings;
  std::apply(
      [&](const auto&... f) {
        (settings.push_back({f.name, detail::value_text(parameters.*(f.member))}), ...);
      },
      P::fields());
  return settings;
}

/// The settings of `to` whose value differs from that in `from`, compared in SI units; what is not
/// set has its default.
[[nodiscard]] ParameterSettings changed_settings(const std::vector<ParameterInfo>& infos,
                                                 const ParameterSettings& from,
                                                 const ParameterSettings& to);

}  // namespace quoin
