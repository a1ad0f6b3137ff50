// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include <chrono>
#include <iostream>
#include <map>
#include <memory>
#include <set>
#include <string>

#include <nlohmann/json.hpp>

#include "deploy/command/commands.hpp"
#include "deploy/observation/display.hpp"
#include "deploy/observation/monitor.hpp"
#include "deploy/observation/summary.hpp"
#include "deploy/observation/table.hpp"
#include "deploy/orchestration/apply_requests.hpp"
#include "deploy/orchestration/composition.hpp"
#include "deploy/orchestration/dialogue.hpp"
#include "deploy/orchestration/exclusive.hpp"
#include "deploy/orchestration/file_watch.hpp"
#include "deploy/orchestration/host.hpp"
#include "deploy/orchestration/launch.hpp"
#include "deploy/orchestration/requester.hpp"
#include "deploy/orchestration/signals.hpp"
#include "deploy/orchestration/supervisor.hpp"
#include "services/deployment/deployment.hpp"

namespace quoin::deploy {

namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

// On top of what new processes may take: until all hosts are ready, and while others do their
// changes.
constexpr milliseconds cue_patience{60'000};

struct UpOptions {
  std::string file;
  std::string host;
  double duration = 0.0;  // [s]; 0: no end
  bool json = false;
  bool quiet = false;
  bool watch = false;
};

Display::Mode display_mode(const UpOptions& options) {
  if (options.quiet) return Display::Mode::quiet;
  return options.json ? Display::Mode::errors : Display::Mode::automatic;
}

/// One run of a deployment, from the first process to the last figures.
class Run {
 public:
  explicit Run(const UpOptions& options)
      : options_(options),
        watch_(options.file),
        composition_(options.file, options.host),
        exclusive_(composition_.deployment()),
        monitor_(composition_.deployment(), composition_.host()),
        requester_(monitor_.participant(), composition_.deployment().name_space),
        apply_requests_(monitor_.participant(), composition_.deployment().name_space,
                        supervisor_name(composition_.host())),
        display_(display_mode(options)),
        supervisor_(composition_.plans(),
                    {.output = [this](const std::string& name,
                                      const std::string& line) { log(name, line); },
                     .event =
                         [this](const std::string& name, const std::string& text) {
                           display_.log("quoin", name + ": " + text);
                         },
                     .was_active =
                         [this](const std::string& name) {
                           // Of strangers nobody knows whether they are.
                           return name == discovery_process || !monitor_.knows(name) ||
                                  monitor_.was_active(name);
                         }}) {}

  int run() {
    begun_ = Clock::now();
    supervisor_.start();
    while (!supervisor_.ended()) {
      look(milliseconds(50));
      if (supervisor_.stopping()) continue;
      if (auto request = apply_requests_.take(composition_.deployment().file.string())) {
        answer(*request);
      } else if (options_.watch && watch_.changed()) {
        apply({.file = options_.file}, [](const Plan&) {});
      }
    }
    monitor_.finish(orderly_ended(), milliseconds(1000));
    const DeploymentFigures last = figures();
    display_.finish(last);
    if (options_.json) {
      std::cout << summary(last).dump(2, ' ', false,
                                      nlohmann::ordered_json::error_handler_t::replace)
                << std::endl;
    }
    return exit_code_ != exit_ok ? exit_code_ : supervisor_.exit_code();
  }

 private:
  void say(const std::string& text) { display_.log("quoin", text); }

  void log(const std::string& name, const std::string& line) {
    last_lines_[name] = line;
    display_.log(name, line);
  }

  /// Lets everything go on for up to `timeout`; false when it is to stop.
  bool look(milliseconds timeout) {
    if (supervisor_.poll(timeout, signals_.descriptor())) handle_signals(signals_.take());
    observe();
    if (!supervisor_.ended()) display_.show(figures());
    return !supervisor_.stopping();
  }

  ApplyOutcome apply(ApplyRequest request, const std::function<void(const Plan&)>& on_plan) {
    last_lines_.clear();
    Dialogue dialogue(supervisor_, requester_, [this] {
      apply_requests_.attend(conducted_);
      return look(milliseconds(2));
    });
    if (conducted_ != nullptr) {
      request.next_cue = [this, &dialogue, cue = std::optional<msg::ControlRequest>(),
                          patience = request.patience](bool begun) mutable {
        return next_cue(dialogue, begun, patience, cue);
      };
    }
    const Changeover::World world{
        .supervisor = supervisor_,
        .monitor = monitor_,
        .dialogue = dialogue,
        .withdrawn = [this] { return apply_requests_.withdrawn(); },
        .last_line = [this](const std::string& name) { return last_lines_[name]; }};
    const ApplyOutcome outcome = composition_.apply(world, request, [&](const Plan& plan) {
      if (!request.dry_run) say("applying " + request.file.string());
      for (const Change& change : plan.changes) {
        if (!request.dry_run && change.action != ChangeAction::keep) say(to_text(change));
      }
      on_plan(plan);
    });
    if (!outcome.accepted) {
      say(request.file.string() + " was not applied" +
          (outcome.rolled_back ? "; all is as it was: " : ": ") + outcome.detail);
    } else if (!request.dry_run) {
      say(request.file.string() + " is applied");
    }
    return outcome;
  }

  /// Tells that everything is ready, or that the change of `last` has been done, and waits.
  Cue next_cue(Dialogue& dialogue, bool begun, milliseconds patience,
               std::optional<msg::ControlRequest>& last) {
    msg::ControlReply reply;
    reply.accepted(true);
    reply.pending(!begun);
    reply.ready(!begun);
    apply_requests_.reply(begun ? *last : *conducted_, reply);
    const bool came = dialogue.wait_until(
        [&] { return (last = apply_requests_.take_cue()).has_value(); }, patience + cue_patience);
    const bool withdraw = came && last->action() == msg::ControlAction::CONTROL_WITHDRAW;
    if (begun && (!came || withdraw)) return {Cue::Kind::finish, ""};
    if (supervisor_.stopping()) return {Cue::Kind::withdraw, "the deployment is stopping"};
    if (!came) return {Cue::Kind::withdraw, "who asked for it did not tell to go on"};
    if (withdraw) return {Cue::Kind::withdraw, withdrawn};
    if (last->change().empty()) return {Cue::Kind::finish, ""};
    return {Cue::Kind::change, last->change()};
  }

  void answer(const msg::ControlRequest& request) {
    conducted_ = request.in_concert() ? &request : nullptr;
    const ApplyOutcome outcome = apply(apply_request(request), [&](const Plan& plan) {
      if (request.dry_run()) return;
      msg::ControlReply reply;
      reply.accepted(true);
      reply.pending(true);
      reply.steps(steps_of(plan));
      apply_requests_.reply(request, reply);
    });
    conducted_ = nullptr;
    msg::ControlReply reply;
    reply.accepted(outcome.accepted);
    reply.detail(outcome.detail);
    reply.rolled_back(outcome.rolled_back);
    reply.steps(outcome.steps);
    apply_requests_.reply(request, reply);
  }

  void handle_signals(int count) {
    while (count-- > 0) {
      if (!stop_asked_) {
        say("stopping, sources first; once more kills");
        stop_asked_ = true;
        supervisor_.request_stop();
      } else {
        say("killing all");
        supervisor_.kill_all();
      }
    }
  }

  void observe() {
    const auto now = Clock::now();
    if (supervisor_.stopping()) {
      if (active_since_ && !active_until_) active_until_ = now;
      return;
    }
    if (!active_since_ && monitor_.all_were_active()) {
      active_since_ = now;
      say("all services are active after " +
          fixed(std::chrono::duration<double>(now - begun_).count(), 2) + " s");
    }
    if (!active_since_) observe_start(now);
    if (options_.duration > 0.0 && active_since_ && duration(now) >= options_.duration) {
      supervisor_.request_stop();
    }
    warn_of_strangers();
  }

  void observe_start(Clock::time_point now) {
    if (now - begun_ < std::chrono::seconds(30) || start_warned_) return;
    start_warned_ = true;
    say("not active after 30 s: " + monitor_.never_active());
    if (options_.duration > 0.0) {
      // The time to run would never begin.
      exit_code_ = exit_failure;
      supervisor_.request_stop();
    }
  }

  /// Services started alone under the same names would mix their messages with ours.
  void warn_of_strangers() {
    for (const auto& [name, processes] : monitor_.processes()) {
      for (const int process : processes) {
        if (supervisor_.started(process) || !strangers_.insert(process).second) continue;
        say("process " + std::to_string(process) + " also runs as service '" + name +
            "' of namespace '" + composition_.deployment().name_space + "' in domain " +
            std::to_string(composition_.deployment().domain) +
            "; figures are mixed. Give one of the two another namespace or domain");
      }
    }
  }

  [[nodiscard]] double duration(Clock::time_point now) const {
    if (!active_since_) return 0.0;
    return std::chrono::duration<double>(active_until_.value_or(now) - *active_since_).count();
  }

  [[nodiscard]] DeploymentFigures figures() const {
    DeploymentFigures figures = monitor_.figures();
    figures.duration = duration(Clock::now());
    for (ServiceFigures& service : figures.services) {
      if (monitor_.removed(service.name)) {
        service.report.state = "removed";
        service.report.rate = 0.0;
        continue;
      }
      const ProcessFigures process = supervisor_.figures(service.name);
      service.restarts = process.restarts;
      std::string& state = service.report.state;
      if (process.phase == ProcessPhase::pausing) {
        state = "restarting";
      } else if (process.phase == ProcessPhase::dead && state != "failed") {
        state = "dead";
      } else if (process.phase == ProcessPhase::running &&
                 monitor_.newest_process(service.name) != process.process_id) {
        state = "starting";  // nothing heard of the new process yet
      }
      if (process.phase == ProcessPhase::pausing || process.phase == ProcessPhase::dead) {
        service.report.rate = 0.0;
      }
      // The last heartbeat's rate is that of a fraction of a second.
      if (supervisor_.ended() && figures.duration > 0.0) {
        service.report.rate = static_cast<double>(service.report.published) / figures.duration;
      }
    }
    return figures;
  }

  [[nodiscard]] std::vector<std::string> orderly_ended() const {
    std::vector<std::string> names;
    for (const ServiceConfig& service : composition_.deployment().services) {
      if (service.host == composition_.host() && service.has_process() && !service.external() &&
          supervisor_.figures(label(service)).phase == ProcessPhase::finished) {
        names.push_back(label(service));
      }
    }
    return names;
  }

  UpOptions options_;
  FileWatch watch_;  // before the file is read
  Composition composition_;
  Exclusive exclusive_;
  Signals signals_;  // before the threads of the monitor
  Monitor monitor_;
  Requester requester_;
  ApplyRequests apply_requests_;
  Display display_;
  Supervisor supervisor_;  // last: what it calls outlives it
  Clock::time_point begun_;
  std::optional<Clock::time_point> active_since_;
  std::optional<Clock::time_point> active_until_;
  std::set<int> strangers_;
  const msg::ControlRequest* conducted_ = nullptr;  // what is applied with other hosts, if anything
  std::map<std::string, std::string> last_lines_;   // of the services, since the last apply
  bool stop_asked_ = false;
  bool start_warned_ = false;
  int exit_code_ = exit_ok;
};

}  // namespace

Command add_up(CLI::App& app) {
  CLI::App* line =
      app.add_subcommand("up", "Start a deployment and watch over it until it ends or Ctrl-C");
  const auto options = std::make_shared<UpOptions>();
  line->add_option("file", options->file, "Deployment file (YAML)")->required();
  line->add_option("--host", options->host,
                   "Start the share of this host; else of the one called like this machine");
  line->add_option("--duration", options->duration,
                   "Stop after this time [s], counted from when all are active")
      ->check(more_than_zero());
  line->add_flag("--json", options->json,
                 "Print the final figures as a JSON object; progress goes to standard error");
  line->add_flag("--watch", options->watch,
                 "Apply the file whenever it changes; with errors in it nothing changes");
  line->add_flag("--quiet", options->quiet, "Show log lines only");
  return {line, [options] { return Run(*options).run(); }};
}

}  // namespace quoin::deploy
