// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/parameters/changed_settings.hpp"

#include <algorithm>
#include <cmath>
#include <string>

namespace quoin {
namespace {

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

}  // namespace quoin
