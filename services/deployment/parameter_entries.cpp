// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/deployment/parameter_entries.hpp"

#include <algorithm>
#include <stdexcept>

#include "core/text/printable.hpp"
#include "services/deployment/environment.hpp"

namespace quoin {

namespace {

void check_setting(const ParameterSetting& setting, const Entry& entry,
                   const ServiceConfig& service, const std::vector<ParameterInfo>& infos,
                   Problems& problems) {
  try {
    check_parameters(infos, {setting});
  } catch (const ParameterError& error) {
    const bool known = std::any_of(infos.begin(), infos.end(), [&](const ParameterInfo& info) {
      return info.name == setting.name;
    });
    if (known) {
      problems.add(entry.value_at, "parameter '" + setting.name + "' of service '" + service.name +
                                       "': " + error.what());
    } else {
      problems.add(entry.key_at, "service '" + service.name + "': " + error.what() +
                                     " (quoin methods " + service.kind + " lists them)");
    }
  }
}

}  // namespace

ParameterSettings read_parameters(const Entry& entry, const ServiceConfig& service,
                                  const std::vector<ParameterInfo>* known, Problems& problems) {
  ParameterSettings settings;
  if (entry.value.IsNull()) return settings;
  if (!entry.value.IsMap()) {
    problems.add(entry.value_at, "'" + entry.key + "' must be a map of names and values, not " +
                                     what_is(entry.value));
    return settings;
  }
  const std::string owner = "the " + entry.key + " of '" + service.name + "'";
  for (const Entry& parameter : entries_of(entry.value, owner, problems)) {
    const std::string place = "parameter '" + parameter.key + "' of service '" + service.name + "'";
    if (!parameter.value.IsScalar()) {
      problems.add(parameter.value_at,
                   place + " must be a single value, not " + what_is(parameter.value));
      continue;
    }
    ParameterSetting setting{parameter.key, parameter.value.Scalar()};
    try {
      setting.text = replace_variables(parameter.value.Scalar(), environment_variable);
    } catch (const std::invalid_argument& error) {
      problems.add(parameter.value_at, place + ": " + error.what());
      settings.push_back(std::move(setting));  // it is there, if only with a wrong value
      continue;
    }
    if (!is_printable(setting.text)) {
      problems.add(parameter.value_at, place + " must be one line of printable characters");
      continue;
    }
    if (known != nullptr) check_setting(setting, parameter, service, *known, problems);
    settings.push_back(std::move(setting));
  }
  return settings;
}

std::optional<double> read_seconds(const Entry& entry, const std::string& what, double lowest,
                                   double highest, Problems& problems) {
  const auto text = read_text(entry, problems);
  if (!text) return std::nullopt;
  ParameterInfo info;
  info.name = entry.key;
  info.type = ParameterType::real;
  info.unit = "s";
  info.minimum = lowest;
  info.maximum = highest;
  try {
    return detail::parse_real(info, *text);
  } catch (const ParameterError& error) {
    problems.add(entry.value_at, what + ": " + error.what());
    return std::nullopt;
  }
}

}  // namespace quoin
