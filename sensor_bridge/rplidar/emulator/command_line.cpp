// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "sensor_bridge/rplidar/emulator/command_line.hpp"

#include <algorithm>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>

#include "sensor_bridge/excerpt.hpp"
#include "sensor_bridge/number.hpp"
#include "sensor_bridge/rplidar/emulator/fault.hpp"

namespace quoin::sensor_bridge::rplidar {
namespace {

// "[ADDRESS:]PORT", an IPv6 address in brackets.
void set_network(EmulatorSettings& settings, const std::string& connection,
                 const std::string& text) {
  const std::size_t colon = text.rfind(':');
  const auto port = sensor_bridge::parse_number<std::uint16_t>(
      colon == std::string::npos ? text : text.substr(colon + 1));
  if (!port) {
    throw CLI::ValidationError(
        "--" + connection, excerpt(text) + " is no [ADDRESS:]PORT, such as 20108 or 0.0.0.0:20108");
  }
  settings.connection = connection;
  settings.port = *port;
  if (colon == std::string::npos) return;
  settings.address = text.substr(0, colon);
  if (settings.address.starts_with('[') && settings.address.ends_with(']')) {
    settings.address = settings.address.substr(1, settings.address.size() - 2);
  }
}

std::string fault_help() {
  std::string names;
  for (const std::string& name : fault_names()) names += (names.empty() ? "" : ", ") + name;
  return "misbehaviour to come, such as 'unplug@20s+5s, wrong_checksums=0.3@10s+2s': " + names;
}

// What has an option of its own below.
bool is_told_otherwise(std::string_view setting) {
  return setting == "connection" || setting == "link" || setting == "address" ||
         setting == "port" || setting == "faults";
}

template <class T>
void add_setting(CLI::App& app, const ParameterField<EmulatorSettings, T>& field,
                 EmulatorSettings& settings) {
  if (is_told_otherwise(field.name)) return;
  std::string name = std::string("--") + field.name;
  std::replace(name.begin(), name.end(), '_', '-');
  T& value = settings.*field.member;
  if constexpr (std::is_same_v<T, bool>) {
    app.add_flag(name, value, field.description);
  } else {
    const std::string unit = *field.unit == '\0' ? "" : std::string(" [") + field.unit + "]";
    CLI::Option* option =
        app.add_option(name, value, field.description + unit)->capture_default_str();
    if constexpr (std::is_arithmetic_v<T>) {
      option->check(CLI::Range(static_cast<T>(field.minimum), static_cast<T>(field.maximum)));
    }
  }
}

}  // namespace

void add_options(CLI::App& app, CommandLine& line) {
  EmulatorSettings& settings = line.settings;
  CLI::Option* pty = app.add_flag(
      "--pty", [&](std::int64_t) { settings.connection = "pty"; },
      "on a pseudo-terminal (default)");
  CLI::Option* link =
      app.add_option("--link", settings.link, "symbolic link to the pseudo-terminal");
  CLI::Option* tcp = app.add_option_function<std::string>(
      "--tcp", [&](const std::string& text) { set_network(settings, "tcp", text); },
      "as a TCP server on [ADDRESS:]PORT; address 127.0.0.1 when left out, port 0 for any");
  CLI::Option* udp = app.add_option_function<std::string>(
      "--udp", [&](const std::string& text) { set_network(settings, "udp", text); },
      "on UDP [ADDRESS:]PORT, likewise");
  pty->excludes(tcp)->excludes(udp);
  tcp->excludes(udp);
  link->excludes(tcp)->excludes(udp);

  std::apply([&](const auto&... field) { (add_setting(app, field, settings), ...); },
             EmulatorSettings::fields());
  app.add_option("--faults", settings.faults, fault_help());
  app.add_flag("--quiet", line.quiet, "prints the endpoint only");
}

}  // namespace quoin::sensor_bridge::rplidar
