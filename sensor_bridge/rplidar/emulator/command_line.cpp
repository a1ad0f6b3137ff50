// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "sensor_bridge/rplidar/emulator/command_line.hpp"

#include <string>

#include "sensor_bridge/excerpt.hpp"
#include "sensor_bridge/number.hpp"
#include "sensor_bridge/rplidar/emulator/device_identity.hpp"
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
  return "Misbehaviour to come, such as 'unplug@20s+5s, wrong_checksums=0.3@10s+2s': " + names;
}

}  // namespace

void add_options(CLI::App& app, CommandLine& line) {
  EmulatorSettings& settings = line.settings;
  app.add_option("--environment", settings.environment, "Built-in world, or path of a world file")
      ->capture_default_str();
  app.add_option("--speed", settings.speed, "Speed along the world's path [m/s]")
      ->check(CLI::Range(0.0, 100.0))
      ->capture_default_str();

  CLI::Option* pty = app.add_flag(
      "--pty", [&](std::int64_t) { settings.connection = "pty"; },
      "On a pseudo-terminal (default)");
  CLI::Option* link =
      app.add_option("--link", settings.link, "Symbolic link to the pseudo-terminal");
  CLI::Option* tcp = app.add_option_function<std::string>(
      "--tcp", [&](const std::string& text) { set_network(settings, "tcp", text); },
      "TCP server on [ADDRESS:]PORT; address 127.0.0.1 when left out, port 0 for any");
  CLI::Option* udp = app.add_option_function<std::string>(
      "--udp", [&](const std::string& text) { set_network(settings, "udp", text); },
      "UDP on [ADDRESS:]PORT, likewise");
  pty->excludes(tcp)->excludes(udp);
  tcp->excludes(udp);
  link->excludes(tcp)->excludes(udp);

  app.add_option("--baud-rate", settings.baud_rate, "Of the device's serial line [bit/s]")
      ->capture_default_str();
  app.add_option("--frequency", settings.frequency, "Revolutions a second until a client sets it")
      ->check(CLI::Range(smallest_speed / 60.0, largest_speed / 60.0))
      ->capture_default_str();
  app.add_option("--spin-up-time", settings.spin_up_time, "From rest to 10 Hz [s]")
      ->check(CLI::Range(0.0, 3600.0))
      ->capture_default_str();
  app.add_option("--reset-time", settings.reset_time, "Deaf after a reset [s]")
      ->check(CLI::Range(0.0, 3600.0))
      ->capture_default_str();
  app.add_option("--range-stddev", settings.range_stddev, "Noise of each range [m]")
      ->check(CLI::Range(0.0, 1.0))
      ->capture_default_str();
  app.add_option("--clock-error", settings.clock_error, "Of the device's clock; positive is slow")
      ->check(CLI::Range(-0.01, 0.01))
      ->capture_default_str();
  app.add_option("--seed", settings.seed, "Of the noise")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  app.add_option("--serial-number", settings.serial_number, "32 hexadecimal digits")
      ->capture_default_str();
  app.add_flag("--all-formats", settings.all_formats,
               "Scan modes for the formats that an S1 does not send, too");
  app.add_option("--faults", settings.faults, fault_help());
  app.add_flag("--quiet", line.quiet, "Prints the endpoint only");
}

}  // namespace quoin::sensor_bridge::rplidar
