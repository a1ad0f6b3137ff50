// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <chrono>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include "deploy/command/commands.hpp"
#include "deploy/diagnostics/lidar_checks.hpp"
#include "deploy/diagnostics/lidar_report.hpp"
#include "sensor_bridge/transport/find_port.hpp"
#include "services/runtime/process/stop_signal.hpp"

namespace quoin::deploy {
namespace {

using namespace sensor_bridge;
using namespace sensor_bridge::rplidar;
using Json = nlohmann::ordered_json;

struct LidarOptions {
  std::string port;  // empty: look at all
  unsigned baud_rate = 0;
  std::string scan_mode;
  double scan_frequency = 0.0;  // [Hz]
  double seconds = 10.0;
  bool idle = false;
  bool json = false;
};

void add_options(CLI::App& line, LidarOptions& options) {
  line.add_option("port", options.port,
                  "Serial device, tcp://host[:port] or udp://host[:port]; else every USB adapter "
                  "of the type that RPLIDARs come with");
  line.add_option("--baud-rate", options.baud_rate, "Tried first; else the usual ones");
  line.add_option("--scan-mode", options.scan_mode, "To measure with; else the device's choice");
  line.add_option("--scan-frequency", options.scan_frequency, "Likewise [Hz]")
      ->check(CLI::NonNegativeNumber);
  line.add_option("--seconds", options.seconds, "Longest time to measure [s]")
      ->capture_default_str()
      ->check(more_than_zero());
  line.add_flag("--json", options.json, "As a JSON object");
}

std::vector<Endpoint> endpoints(const LidarOptions& options) {
  if (!options.port.empty()) return {find_endpoint(options.port)};
  std::vector<Endpoint> found;
  for (const SerialPortEntry& port : usual_adapters(list_serial_ports())) {
    found.push_back(parse_endpoint(port.name()));
  }
  return found;
}

LidarReport examine(const Endpoint& endpoint, const LidarOptions& options,
                    const Interruption& interruption) {
  constexpr std::size_t revolutions = 10;
  DriverSettings settings{.endpoint = endpoint,
                          .baud_rate = options.baud_rate,
                          .scan_mode = options.scan_mode,
                          .scan_frequency = options.scan_frequency,
                          .time_outs = {}};
  LidarReport report{.probe = probe(settings, interruption), .measurement = {}};
  const bool refuses = report.probe.diagnosis.finding == Finding::protection_stop;
  if (!report.found() || refuses || options.idle) return report;
  settings.baud_rate = report.probe.facts->baud_rate;
  const std::chrono::duration<double> limit(options.seconds);
  report.measurement = measure(settings, revolutions,
                               std::chrono::duration_cast<TimeOuts::Time>(limit), interruption);
  return report;
}

/// Nothing when there is no device to look at. Throws Stopped when the user has had enough.
std::vector<LidarReport> examine_all(const LidarOptions& options) {
  runtime::StopSignal stop;
  const Interruption interruption = [&stop](std::chrono::steady_clock::time_point time) {
    return stop.wait_until(time);
  };
  std::vector<LidarReport> reports;
  for (const Endpoint& endpoint : endpoints(options)) {
    if (!options.json) std::cerr << "looking at " << to_text(endpoint) << " ...\n";
    reports.push_back(examine(endpoint, options, interruption));
  }
  return reports;
}

constexpr const char* nothing_found =
    "no USB serial adapter of the usual type is there; plug the device in, or name its port, "
    "tcp://host or udp://host (quoin lidar list shows all ports)\n";

bool is_fine(const LidarReport& report) {
  const bool measured = !report.measurement || report.measurement->revolutions > 0;
  return report.found() && measured && report.probe.diagnosis.finding != Finding::protection_stop;
}

int run_probe(const LidarOptions& options) {
  const std::vector<LidarReport> reports = examine_all(options);
  Json devices = Json::array();
  for (const LidarReport& report : reports) {
    if (options.json) {
      devices.push_back(to_json(report));
    } else {
      print(report, std::cout);
    }
  }
  if (options.json) std::cout << Json{{"devices", devices}}.dump(2) << '\n';
  if (reports.empty()) std::cerr << nothing_found;
  return !reports.empty() && std::ranges::all_of(reports, is_fine) ? exit_ok : exit_failure;
}

int run_doctor(const LidarOptions& options) {
  const std::vector<LidarReport> reports = examine_all(options);
  Json devices = Json::array();
  bool healthy = !reports.empty();
  for (const LidarReport& report : reports) {
    if (!options.json && report.found()) std::cout << report.probe.facts->endpoint << '\n';
    const Checks checks = lidar_checks(report);
    healthy = healthy && all_good(checks);
    if (!options.json) {
      for (const Check& check : checks) print(check, std::cout);
    }
    devices.push_back({{"device", to_json(report)}, {"checks", to_json(checks)}});
  }
  if (options.json) {
    std::cout << Json{{"healthy", healthy}, {"devices", devices}}.dump(2) << '\n';
  } else if (reports.empty()) {
    std::cerr << nothing_found;
  } else {
    std::cout << (healthy ? "nothing is wrong\n" : "see the arrows for what to do\n");
  }
  return healthy ? exit_ok : exit_failure;
}

int run_list(bool json) {
  const auto ports = list_serial_ports();
  if (json) {
    std::cout << to_json(ports).dump(2) << '\n';
  } else {
    print(ports, std::cout);
  }
  return exit_ok;
}

/// An endpoint that cannot be read is wrong usage.
template <class Run>
int with_exit_codes(const Run& run) {
  try {
    return run();
  } catch (const EndpointError& error) {
    std::cerr << "quoin lidar: " << error.what() << '\n';
    return exit_configuration;
  } catch (const Stopped&) {
    std::cerr << "stopped\n";
    return exit_failure;
  }
}

}  // namespace

Command add_lidar(CLI::App& app) {
  CLI::App* line = app.add_subcommand("lidar", "Find RPLIDARs and what is the matter with them");
  line->require_subcommand(1);
  const auto options = std::make_shared<LidarOptions>();
  CLI::App* list = line->add_subcommand("list", "Show the USB serial ports that are there");
  list->add_flag("--json", options->json, "As a JSON array");
  CLI::App* probe_line = line->add_subcommand(
      "probe", "Show model, firmware, serial number, scan modes, health and measured rate");
  add_options(*probe_line, *options);
  probe_line->add_flag("--idle", options->idle, "Ask only, do not let it turn and measure");
  CLI::App* doctor =
      line->add_subcommand("doctor", "Tell what is wrong with a device and what to do");
  add_options(*doctor, *options);
  return {line, [=] {
            if (list->parsed()) return run_list(options->json);
            return with_exit_codes(
                [&] { return doctor->parsed() ? run_doctor(*options) : run_probe(*options); });
          }};
}

}  // namespace quoin::deploy
