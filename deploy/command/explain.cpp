// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include <chrono>
#include <cmath>
#include <iostream>
#include <memory>
#include <numbers>
#include <optional>
#include <string>

#include <nlohmann/json.hpp>

#include "deploy/command/commands.hpp"
#include "deploy/kinds/kinds.hpp"
#include "deploy/orchestration/requester.hpp"
#include "deploy/orchestration/signals.hpp"
#include "sensor_bridge/number.hpp"
#include "sensor_bridge/recordings/scan_files.hpp"
#include "sensor_bridge/scan_declaration.hpp"
#include "services/deployment/deployment.hpp"
#include "services/explanation/explanation_report.hpp"
#include "services/keys/key_files.hpp"
#include "services/runtime/dds/endpoints.hpp"
#include "services/runtime/dds/participant.hpp"
#include "services/topics/header.hpp"
#include "services/topics/segments.hpp"

namespace quoin::deploy {

namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

struct ExplainOptions {
  std::string file;
  std::string service;
  std::string at;
  std::string scans;  // scan file; "": of the running deployment
  std::optional<std::uint64_t> scan;
  double wait = 10.0;  // [s]
  bool json = false;
};

/// "45" and "45 deg" are bearings, "1.2,-0.5" is a point. Throws std::out_of_range.
Place place_of(const std::string& text) {
  const auto number = [&](std::string part) {
    const std::size_t end = part.find_last_not_of(' ');
    part.resize(end == std::string::npos ? 0 : end + 1);
    const auto value = sensor_bridge::parse_number<double>(part);
    if (!value || !std::isfinite(*value)) {
      throw std::out_of_range("--at '" + text +
                              "' is neither a bearing in degrees nor X,Y in metres");
    }
    return *value;
  };
  const std::size_t comma = text.find(',');
  if (comma != std::string::npos) {
    return Place::at(number(text.substr(0, comma)), number(text.substr(comma + 1)));
  }
  const std::size_t unit = text.find("deg");
  return {number(text.substr(0, unit)) * std::numbers::pi / 180.0};
}

/// A scan of the file, with what the source of the deployment declares of its sensor. Throws
/// ScanFileError and std::out_of_range.
msg::Scan scan_of_file(const ExplainOptions& options, const ServiceConfig& source) {
  sensor_bridge::ReplayParameters parameters;
  if (source.kind == "replay") {
    parameters = make_parameters<sensor_bridge::ReplayParameters>(source.parameters);
  }
  parameters.path = options.scans;
  auto files = sensor_bridge::open_scan_files(parameters, "");
  sensor_bridge::RecordedScan recorded;
  const std::uint64_t wanted = options.scan.value_or(0);
  for (std::uint64_t number = 0; files.next(recorded); ++number) {
    if (number < wanted) continue;
    msg::Scan scan = sensor_bridge::declared_scan(parameters);
    scan.bearings(recorded.bearings);
    scan.ranges(recorded.ranges);
    topics::set_origin(scan.header(), source.name, 0, number);
    return scan;
  }
  throw std::out_of_range(options.scans + ": there is no scan " + std::to_string(wanted));
}

/// The methods and parameters in force, which control may have changed. Where a service does not
/// answer, those of the file stay.
void ask_for_methods(const Deployment& deployment, runtime::Participant& participant,
                     ExplainedServices& services) {
  DdsRequester requester(participant, deployment.name_space);
  const auto ask = [&](const ServiceConfig* service, MethodChoice& choice) {
    if (service == nullptr) return;
    const auto deadline = Clock::now() + milliseconds(1500);
    msg::ControlRequest request;
    request.service(label(*service));
    request.action(msg::ControlAction::CONTROL_DESCRIBE);
    if (!requester.reach(label(*service), deadline)) return;
    const auto reply = requester.ask(request, deadline);
    if (!reply || !reply->accepted()) return;
    choice.method = reply->method();
    choice.settings.clear();
    for (const msg::ParameterSetting& setting : reply->parameters()) {
      choice.settings.push_back({setting.name(), setting.value()});
    }
  };
  ask(services.segmentation, services.chain.segmenter);
  ask(services.line_fitting, services.chain.fitter);
  ask(services.corners, services.chain.finder);
}

/// Nothing when none came; says why.
std::optional<msg::Scan> live_scan(const Deployment& deployment, const ExplainOptions& options,
                                   ExplainedServices& services) {
  Signals signals;
  const OutputConfig* output = services.source->output("scan");
  if (output == nullptr) {
    throw std::out_of_range("service '" + services.source->name + "' publishes no scans");
  }
  auto config = runtime::participant_config(deployment, "quoin_explain", operator_identity);
  config.observes = {output->topic};
  runtime::Participant participant(config);
  runtime::Reader<msg::Scan> reader(participant, output->topic,
                                    runtime::observer_qos(*services.source, *output));
  runtime::WaitSet wait_set;
  wait_set.add(reader);
  const auto deadline = Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                           std::chrono::duration<double>(options.wait));
  msg::Scan scan;
  while (Clock::now() < deadline && signals.take() == 0) {
    wait_set.wait(milliseconds(100));
    while (reader.take(scan)) {
      const std::uint64_t number = topics::sequence_number(scan.header());
      if (options.scan && number < *options.scan) continue;
      if (options.scan && number > *options.scan) {
        std::cerr << "scan " << *options.scan << " has passed, the newest is " << number << '\n';
        return std::nullopt;
      }
      ask_for_methods(deployment, participant, services);
      return scan;
    }
  }
  std::cerr << "no scan came by " << output->topic << " within " << options.wait
            << " s; is the deployment running? (--scans explains a scan of a file)\n";
  return std::nullopt;
}

int run(const ExplainOptions& options) {
  const Place place = place_of(options.at);
  const Deployment deployment = load_deployment(options.file);
  ExplainedServices services = explained_services(deployment, options.service);
  std::optional<msg::Scan> scan;
  try {
    scan = options.scans.empty() ? live_scan(deployment, options, services)
                                 : scan_of_file(options, *services.source);
  } catch (const sensor_bridge::ScanFileError& error) {
    std::cerr << error.what() << '\n';
    return exit_input;
  }
  if (!scan) return exit_failure;
  const Explanation found =
      explain({scan->bearings(), scan->ranges(), scan->range_min(), scan->range_max()},
              topics::sensor_model(scan->sensor_model()), services.chain, place);
  nlohmann::ordered_json report = to_json(services, place, found);
  report["scan"] = topics::sequence_number(scan->header());
  std::cout << (options.json ? report.dump() + "\n"
                             : services.line_fitting->name + ", scan " +
                                   std::to_string(topics::sequence_number(scan->header())) + ": " +
                                   to_text(report));
  return exit_ok;
}

}  // namespace

Command add_explain(CLI::App& app) {
  CLI::App* line = app.add_subcommand(
      "explain", "Why there is a line at a place of a scan, or none: which step, which parameter");
  const auto options = std::make_shared<ExplainOptions>();
  line->add_option("file", options->file, "Deployment file (YAML)")->required();
  line->add_option("--service", options->service,
                   "Service that fits lines, or makes corners of them")
      ->required();
  line->add_option("--at", options->at,
                   "Bearing [deg], or X,Y [m] in the frame of the sensor, as --at=-1.2,0.5")
      ->required();
  line->add_option("--scans", options->scans, "Scan file, in place of the running deployment");
  line->add_option("--scan", options->scan, "Number of the scan; else the first that comes");
  line->add_option("--wait", options->wait, "Give up when nothing arrives for this time [s]")
      ->check(more_than_zero())
      ->capture_default_str();
  line->add_flag("--json", options->json, "One JSON object");
  return {line, [options] { return run(*options); }};
}

}  // namespace quoin::deploy
