// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include <chrono>
#include <filesystem>
#include <fstream>
#include <idl/Scan.h>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <unistd.h>

#include <nlohmann/json.hpp>

#include "deploy/calibration/calibration.hpp"
#include "deploy/calibration/calibration_report.hpp"
#include "deploy/command/commands.hpp"
#include "deploy/export/output_file.hpp"
#include "deploy/kinds/kinds.hpp"
#include "deploy/orchestration/signals.hpp"
#include "sensor_bridge/recordings/scan_files.hpp"
#include "services/deployment/deployment.hpp"
#include "services/keys/key_files.hpp"
#include "services/runtime/accounting/accounting.hpp"
#include "services/runtime/dds/endpoints.hpp"
#include "services/runtime/dds/participant.hpp"

namespace quoin::deploy {

namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

constexpr int exit_undetermined = 4;
constexpr double first_scan_within = 15.0;  // [s]
constexpr double usual_duration = 30.0;     // [s] of a source that does not end

struct CalibrateOptions {
  std::string file;
  std::string service;
  double duration = 0.0;  // [s]; 0: as long as it takes
  std::optional<double> distance;
  std::string output;
  std::string plot;
  bool json = false;
  sensor_bridge::ReplayParameters recording;
};

/// How far it is, in one line of a terminal that is written over; nothing elsewhere.
class Progress {
 public:
  ~Progress() { clear(); }

  void show(const std::string& text) {
    const auto now = Clock::now();
    if (!terminal_ || now - shown_ < milliseconds(100)) return;
    shown_ = now;
    std::cerr << "\r\x1b[K" << text << std::flush;
    visible_ = true;
  }
  void clear() {
    if (visible_) std::cerr << "\r\x1b[K" << std::flush;
    visible_ = false;
  }

 private:
  bool terminal_ = ::isatty(STDERR_FILENO) == 1;
  bool visible_ = false;
  Clock::time_point shown_{};
};

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

bool is_deployment(const std::filesystem::path& file) {
  return file.extension() == ".yaml" || file.extension() == ".yml";
}

/// Throws ScanFileError.
void read_file(const CalibrateOptions& options, Signals& signals, Progress& progress,
               CollectedScans& scans) {
  sensor_bridge::ReplayParameters parameters = options.recording;
  parameters.path = options.file;
  sensor_bridge::ScanFiles files =
      sensor_bridge::open_scan_files(parameters, std::filesystem::current_path());
  sensor_bridge::RecordedScan scan;
  std::optional<double> first;
  while (files.next(scan)) {
    if (options.duration > 0.0 && scan.stamp) {
      if (scan.first_of_file || !first) first = scan.stamp;
      if (*scan.stamp - *first > options.duration) return;
    }
    for (const std::string& note : scan.notes) {
      progress.clear();
      std::cerr << note << '\n';
    }
    scans.add({scan.bearings, scan.ranges});
    progress.show(std::to_string(scans.added()) + " scans read");
    if (signals.take() > 0) return;
  }
}

/// The one that is named, or the only source of scans. Throws std::out_of_range.
const OutputConfig& scans_of(const Deployment& deployment, const std::string& name,
                             const ServiceConfig*& service) {
  if (!name.empty()) {
    service = &deployment.service(name);
  } else {
    std::string sources;
    for (const ServiceConfig& candidate : deployment.services) {
      if (candidate.output("scan") == nullptr) continue;
      sources += (sources.empty() ? "" : ", ") + label(candidate);
      service = &candidate;
    }
    if (sources.find(',') != std::string::npos) {
      throw std::out_of_range(deployment.file.string() + ": several services publish scans: " +
                              sources + "; name one of them");
    }
    if (service == nullptr) {
      throw std::out_of_range(deployment.file.string() + ": no service publishes scans");
    }
  }
  const OutputConfig* output = service->output("scan");
  if (output == nullptr) {
    throw std::out_of_range(deployment.file.string() + ": service '" + service->name +
                            "' publishes no scans; name a source");
  }
  return *output;
}

/// False when nothing came.
bool listen(const CalibrateOptions& options, Signals& signals, Progress& progress,
            CollectedScans& scans) {
  const Deployment deployment = load_deployment(options.file);
  const ServiceConfig* service = nullptr;
  const OutputConfig& output = scans_of(deployment, options.service, service);
  auto config = runtime::participant_config(deployment, "quoin_calibrate", observer_identity);
  config.observes = {output.topic};
  runtime::Participant participant(config);
  runtime::Reader<msg::Scan> reader(participant, output.topic,
                                    runtime::observer_qos(*service, output));
  runtime::WaitSet wait_set;
  wait_set.add(reader);
  runtime::ScanAccounting accounting;
  msg::Scan scan;
  const double duration = options.duration > 0.0 ? options.duration : usual_duration;
  auto start = Clock::now();
  while (signals.take() == 0) {
    wait_set.wait(milliseconds(100));
    while (reader.take(scan)) {
      if (scans.added() == 0) start = Clock::now();
      accounting.receive(scan.header());
      if (accounting.verdict() != runtime::ScanAccounting::Verdict::received) continue;
      scans.add({scan.bearings(), scan.ranges(), scan.range_min(), scan.range_max()});
    }
    const double elapsed = seconds_since(start);
    if (scans.added() == 0 && elapsed > first_scan_within) {
      progress.clear();
      std::cerr << "no scan of '" << service->name << "' came within " << first_scan_within
                << " s; is the deployment running? (quoin up starts it)\n";
      return false;
    }
    if (scans.added() > 0 && elapsed >= duration) return true;
    progress.show(scans.added() == 0 ? "waiting for scans on " + output.topic
                                     : std::to_string(scans.added()) + " scans, " +
                                           std::to_string(static_cast<int>(elapsed)) + " of " +
                                           std::to_string(static_cast<int>(duration)) + " s");
  }
  return true;  // interrupted: what has come is used
}

/// Only what another calibration wrote is replaced. Throws std::out_of_range.
void check_output(const std::string& file) {
  if (file.empty() || !std::filesystem::exists(file)) return;
  std::ifstream stream(file);
  std::string line;
  std::getline(stream, line);
  if (line.starts_with(calibration_marker)) return;
  throw std::out_of_range("-o: '" + file + "' exists and was not written by quoin calibrate; " +
                          "name a new file");
}

int report(const CalibrateOptions& options, const Calibration& calibration) {
  const std::string origin =
      options.file + (options.service.empty() ? "" : ", service " + options.service);
  const std::vector<std::string> missing = shortcomings(calibration);
  if (options.json) {
    std::cout << calibration_json(calibration)
                     .dump(2, ' ', false, nlohmann::json::error_handler_t::replace)
              << '\n';
  } else {
    for (const std::string& line : calibration_lines(calibration)) std::cout << line << '\n';
  }
  if (!options.plot.empty()) write_whole(options.plot, calibration_page(calibration, origin));
  if (!missing.empty()) {
    for (const std::string& text : missing) std::cerr << "missing: " << text << '\n';
    std::cerr << "the scans do not show the noise of their sensor; "
              << (options.output.empty() ? "no sensor model is given"
                                         : options.output + " is not written")
              << '\n';
    return exit_undetermined;
  }
  const std::string block = sensor_block(calibration, origin);
  if (!options.output.empty()) {
    write_whole(options.output, block);
    if (!options.json) std::cout << options.output << '\n';
  } else if (!options.json) {
    std::cout << '\n' << block;
  }
  return exit_ok;
}

int run(const CalibrateOptions& options) {
  check_output(options.output);
  Signals signals;  // before DDS starts its threads
  signals.end_when_stuck();
  Progress progress;
  CollectedScans scans;
  try {
    if (!is_deployment(options.file)) {
      if (!options.service.empty()) {
        std::cerr << options.file << ": a recording has no services; leave '" << options.service
                  << "' out, or give a deployment file (.yaml)\n";
        return exit_configuration;
      }
      read_file(options, signals, progress, scans);
    } else if (!listen(options, signals, progress, scans)) {
      return exit_failure;
    }
  } catch (const sensor_bridge::ScanFileError& error) {
    progress.clear();
    std::cerr << error.what() << '\n';
    return exit_input;
  } catch (const ParameterError& error) {
    progress.clear();
    std::cerr << error.what() << '\n';
    return exit_configuration;
  }
  const auto calibration = calibrate(scans, options.distance, [&](double done) {
    progress.show(std::to_string(scans.added()) + " scans, " +
                  std::to_string(static_cast<int>(100.0 * done)) + " % computed");
    return signals.take() == 0;
  });
  progress.clear();
  if (!calibration) {
    std::cerr << "interrupted; nothing has been written\n";
    return exit_failure;
  }
  return report(options, *calibration);
}

}  // namespace

Command add_calibrate(CLI::App& app) {
  CLI::App* line = app.add_subcommand(
      "calibrate",
      "Measure the noise of a sensor from its scans; gives the sensor block of a "
      "deployment file");
  const auto options = std::make_shared<CalibrateOptions>();
  line->add_option("file", options->file,
                   "Recording (CARMEN, CSV, or a folder of them), or deployment file (.yaml)")
      ->required();
  line->add_option("service", options->service,
                   "Source of a running deployment; else its only source");
  line->add_option("--duration", options->duration,
                   "Time of scans to use; else 30 s of a service, all of a recording")
      ->transform(a_time());
  line->add_option("--distance", options->distance,
                   "True distance [m] from the sensor square to a wall: shows the bias of ranges")
      ->check(more_than_zero());
  line->add_option("-o,--output", options->output, "File for the sensor block (YAML)");
  line->add_option("--plot", options->plot, "Page (HTML) with the noise over range and incidence");
  line->add_option("--field-of-view", options->recording.field_of_view,
                   "Swept angle [rad] of FLASER lines; 0: 180 deg")
      ->check(CLI::Range(0.0, 6.2832))
      ->capture_default_str();
  line->add_option("--range-max", options->recording.range_max,
                   "This range [m] of a recording, and longer ones, are no return")
      ->check(more_than_zero())
      ->capture_default_str();
  line->add_flag("--json", options->json, "All figures as one JSON object");
  return {line, [options] { return run(*options); }};
}

}  // namespace quoin::deploy
