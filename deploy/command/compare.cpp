// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <chrono>
#include <cstdint>
#include <idl/Corners.h>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "deploy/command/commands.hpp"
#include "deploy/kinds/kinds.hpp"
#include "deploy/observation/comparison.hpp"
#include "deploy/observation/comparison_report.hpp"
#include "deploy/observation/display.hpp"
#include "deploy/observation/scan_join.hpp"
#include "deploy/observation/table.hpp"
#include "deploy/orchestration/signals.hpp"
#include "services/deployment/deployment.hpp"
#include "services/keys/key_files.hpp"
#include "services/runtime/dds/endpoints.hpp"
#include "services/runtime/dds/participant.hpp"
#include "services/topics/header.hpp"

namespace quoin::deploy {

namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

struct CompareOptions {
  std::string file;
  std::vector<std::string> services;
  std::string reference;
  double duration = 0.0;    // [s]; 0: no end
  std::uint64_t scans = 0;  // 0: no end
  MatchingGate gate;
  bool json = false;
};

struct Selection {
  std::vector<const ServiceConfig*> services;
  std::size_t reference = 0;
};

/// Throws std::out_of_range for what is no corner service, or looks at other scans.
Selection select(const Deployment& deployment, const CompareOptions& options) {
  std::vector<std::string> names = options.services;
  if (names.empty()) {
    for (const ServiceConfig& service : deployment.services) {
      if (service.output("corners") != nullptr) names.push_back(service.name);
    }
  }
  if (names.empty()) {
    throw std::out_of_range(deployment.file.string() +
                            ": no corner service to compare; add one of kind corner_estimation");
  }
  const std::string reference = options.reference.empty() ? names.front() : options.reference;
  if (std::ranges::find(names, reference) == names.end()) {
    names.insert(names.begin(), reference);
  }
  const CornerChain reference_chain = corner_chain(deployment, reference);
  Selection selection;
  for (const std::string& name : names) {
    const CornerChain chain = corner_chain(deployment, name);
    if (std::ranges::find(selection.services, chain.corners) != selection.services.end()) continue;
    if (chain.source != reference_chain.source) {
      const std::string what = "'" + name + "' takes its scans from '" + chain.source->name +
                               "', the reference '" + reference + "' from '" +
                               reference_chain.source->name + "'";
      if (!options.services.empty()) {
        throw std::out_of_range(deployment.file.string() + ": " + what +
                                "; compare services of one source");
      }
      std::cerr << what << "; left out (--reference compares the others)\n";
      continue;
    }
    if (name == reference) selection.reference = selection.services.size();
    selection.services.push_back(chain.corners);
  }
  return selection;
}

CornerResult result_of(const msg::Corners& message) {
  CornerResult result;
  const auto& trace = message.header().trace();
  result.latency = static_cast<double>(trace.back().published() - trace.front().published()) * 1e-9;
  for (const msg::StageTrace& stage : trace) {
    if (stage.method().empty()) continue;
    result.methods += (result.methods.empty() ? "" : "/") + stage.method();
  }
  result.corners.reserve(message.corners().size());
  for (const msg::Corner& corner : message.corners()) {
    CornerEstimate& estimate = result.corners.emplace_back();
    estimate.position << corner.x(), corner.y();
    estimate.covariance << corner.covariance_xx(), corner.covariance_xy(), corner.covariance_xy(),
        corner.covariance_yy();
  }
  return result;
}

runtime::ParticipantConfig participant_of(const Deployment& deployment,
                                          const Selection& selection) {
  auto config = runtime::participant_config(deployment, "quoin_compare", observer_identity);
  for (const ServiceConfig* service : selection.services) {
    config.observes.push_back(service->output("corners")->topic);
  }
  return config;
}

/// Listens to the corner services, until it has seen enough.
class Listener {
 public:
  Listener(const CompareOptions& options, const Deployment& deployment, const Selection& selection)
      : options_(options),
        deployment_(deployment),
        selection_(selection),
        participant_(participant_of(deployment, selection)),
        comparison_(names(selection), selection.reference, options.gate, options.scans),
        display_(options.json ? Display::Mode::errors : Display::Mode::automatic) {
    for (const ServiceConfig* service : selection.services) {
      readers_.push_back(std::make_unique<runtime::Reader<msg::Corners>>(
          participant_, service->output("corners")->topic,
          runtime::observer_qos(*service, *service->output("corners"))));
      wait_set_.add(*readers_.back());
    }
  }

  int run(Signals& signals) {
    wait_for_writers();
    begun_ = Clock::now();
    while (signals.take() == 0 && !enough()) {
      wait_set_.wait(milliseconds(100));
      take_all();
      if (display_.due()) display_.show(view(figures()));
    }
    take_what_is_under_way();
    const ComparisonFigures last = figures();
    display_.finish(view(last));
    if (options_.json) {
      std::cout << summary(last).dump(2, ' ', false,
                                      nlohmann::ordered_json::error_handler_t::replace)
                << std::endl;
    }
    return last.scans > 0 ? exit_ok : exit_failure;
  }

 private:
  static std::vector<std::string> names(const Selection& selection) {
    std::vector<std::string> names;
    for (const ServiceConfig* service : selection.services) names.push_back(service->name);
    return names;
  }

  static View view(const ComparisonFigures& figures) {
    return {.table = [&figures](std::size_t width) { return table_lines(figures, width); },
            .footer =
                [&figures] {
                  return fixed(figures.duration, 1) + " s, " + std::to_string(figures.scans) +
                         " scans, against " + figures.services[figures.reference].name;
                },
            .line = [&figures] { return progress_line(figures); }};
  }

  /// So that all begin with the same scan.
  void wait_for_writers() {
    const auto deadline = Clock::now() + milliseconds(1500);
    for (std::size_t i = 0; i < readers_.size(); ++i) {
      const auto left = std::chrono::duration_cast<milliseconds>(deadline - Clock::now());
      if (readers_[i]->wait_for_writers(1, std::max(left, milliseconds(0)))) continue;
      display_.log("quoin", "nobody publishes " + selection_.services[i]->output("corners")->topic +
                                " yet; waiting (quoin up starts a deployment)");
    }
    for (const auto& reader : readers_) {
      while (reader->take(message_)) {
      }
    }
  }

  [[nodiscard]] bool enough() {
    if (comparison_.full()) return true;
    if (options_.duration > 0.0 && duration() >= options_.duration) return true;
    const bool published = comparison_.scans() > 0;
    if (!published || std::ranges::any_of(readers_, [](const auto& r) { return r->matched() > 0; }))
      return false;
    display_.log("quoin", "none of the services publishes any more");
    return true;
  }

  bool take_all() {
    bool any = false;
    for (std::size_t i = 0; i < readers_.size(); ++i) {
      while (readers_[i]->take(message_)) {
        any = true;
        const msg::Header& header = message_.header();
        if (header.trace().empty()) continue;  // not from a stage of this project
        comparison_.add(i,
                        {topics::source(header), header.trace().front().incarnation(),
                         topics::sequence_number(header)},
                        result_of(message_));
      }
    }
    return any;
  }

  void take_what_is_under_way() {
    ended_ = Clock::now();
    take_all();
    comparison_.close();
    const auto deadline = *ended_ + milliseconds(1000);
    while (comparison_.open() > 0 && Clock::now() < deadline) {
      wait_set_.wait(milliseconds(50));
      take_all();
    }
    comparison_.finish();
  }

  [[nodiscard]] double duration() const {
    return std::chrono::duration<double>(ended_.value_or(Clock::now()) - begun_).count();
  }

  [[nodiscard]] ComparisonFigures figures() const {
    ComparisonFigures figures = comparison_.figures();
    figures.deployment = deployment_.file.string();
    figures.duration = duration();
    return figures;
  }

  const CompareOptions& options_;
  const Deployment& deployment_;
  const Selection& selection_;
  runtime::Participant participant_;
  std::vector<std::unique_ptr<runtime::Reader<msg::Corners>>> readers_;
  runtime::WaitSet wait_set_;
  Comparison comparison_;
  Display display_;
  msg::Corners message_;
  Clock::time_point begun_;
  std::optional<Clock::time_point> ended_;
};

int run(const CompareOptions& options) {
  const Deployment deployment = load_deployment(options.file);
  const Selection selection = select(deployment, options);
  Signals signals;  // before DDS starts its threads
  signals.end_when_stuck();
  return Listener(options, deployment, selection).run(signals);
}

}  // namespace

Command add_compare(CLI::App& app) {
  CLI::App* line = app.add_subcommand(
      "compare", "Compare the corner services of a running deployment scan by scan");
  const auto options = std::make_shared<CompareOptions>();
  line->add_option("file", options->file, "Deployment file (YAML)")->required();
  line->add_option("--services", options->services, "Corner services; else all of the file")
      ->delimiter(',');
  line->add_option("--reference", options->reference,
                   "The one that the others are compared with; else the first");
  line->add_option("--duration", options->duration, "End after this time [s]")->transform(a_time());
  line->add_option("--scans", options->scans, "End after this many scans")->check(more_than_zero());
  line->add_option("--max-distance", options->gate.largest_distance,
                   "Corners farther apart than this are not the same [m]")
      ->check(more_than_zero())
      ->capture_default_str();
  line->add_flag("--json", options->json,
                 "Print the final figures as a JSON object; progress goes to standard error");
  return {line, [options] { return run(*options); }};
}

}  // namespace quoin::deploy
