// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "deploy/orchestration/run.hpp"

#include <utility>

#include "deploy/observation/table.hpp"
#include "deploy/orchestration/host.hpp"
#include "deploy/orchestration/launch.hpp"
#include "services/deployment/deployment.hpp"

namespace quoin::deploy {

namespace {

using std::chrono::milliseconds;

// On top of what new processes may take: until all hosts are ready, and while others do their
// changes.
constexpr milliseconds instruction_timeout{60'000};

}  // namespace

Run::Run(const RunOptions& options, Callbacks callbacks)
    : options_(options),
      callbacks_(std::move(callbacks)),
      watch_(options.file),
      composition_(options.file, options.host),
      exclusive_(composition_.deployment()),
      monitor_(composition_.deployment(), composition_.host()),
      requester_(monitor_.participant(), composition_.deployment().name_space),
      apply_requests_(monitor_.participant(), composition_.deployment().name_space,
                      supervisor_name(composition_.host())),
      supervisor_(composition_.plans(),
                  {.output =
                       [this](const std::string& name, const std::string& line) {
                         last_lines_[name] = line;
                         callbacks_.log(name, line);
                       },
                   .event = [this](const std::string& name,
                                   const std::string& text) { say(name + ": " + text); },
                   .was_active =
                       [this](const std::string& name) {
                         // Of external services nobody knows whether they are.
                         return name == discovery_process || !monitor_.record().knows(name) ||
                                monitor_.record().was_active(name);
                       }}),
      active_time_(options.duration) {}

RunOutcome Run::run() {
  active_time_ = ActiveTime(options_.duration);
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
  return {exit_code_ != exit_ok ? exit_code_ : supervisor_.exit_code(), figures()};
}

// Lets everything go on for up to `timeout`; false when it is to stop.
bool Run::look(milliseconds timeout) {
  if (supervisor_.poll(timeout, signals_.descriptor())) handle_signals(signals_.take());
  observe();
  if (!supervisor_.ended()) callbacks_.progress(figures());
  return !supervisor_.stopping();
}

void Run::handle_signals(int count) {
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

void Run::observe() {
  const auto now = ActiveTime::Clock::now();
  switch (active_time_.update(monitor_.record().all_were_active(), supervisor_.stopping(), now)) {
    case ActiveTime::Event::none:
      break;
    case ActiveTime::Event::active:
      say("all services are active after " + fixed(active_time_.start_seconds(), 2) + " s");
      break;
    case ActiveTime::Event::late:
      say("not active after 30 s: " + monitor_.record().never_active());
      if (options_.duration > 0.0) {
        // The time to run would never begin.
        exit_code_ = exit_failure;
        supervisor_.request_stop();
      }
      break;
    case ActiveTime::Event::over:
      supervisor_.request_stop();
      break;
  }
  if (!supervisor_.stopping()) warn_of_strangers();
}

// Services started alone under the same names would mix their messages with ours.
void Run::warn_of_strangers() {
  for (const auto& [name, processes] : monitor_.record().processes()) {
    for (const int process : processes) {
      if (supervisor_.started(process) || !strangers_.insert(process).second) continue;
      say("process " + std::to_string(process) + " also runs as service '" + name +
          "' of namespace '" + composition_.deployment().name_space + "' in domain " +
          std::to_string(composition_.deployment().domain) +
          "; figures are mixed. Give one of the two another namespace or domain");
    }
  }
}

ApplyOutcome Run::apply(ApplyRequest request, const std::function<void(const Plan&)>& on_plan) {
  last_lines_.clear();
  Dialogue dialogue(supervisor_, requester_, [this] {
    apply_requests_.attend(conducted_);
    return look(milliseconds(2));
  });
  if (conducted_ != nullptr) {
    request.next_instruction = [this, &dialogue, instruction = std::optional<msg::ControlRequest>(),
                                timeout = request.timeout](bool begun) mutable {
      return next_instruction(dialogue, begun, timeout, instruction);
    };
  }
  const Changeover::World world{
      .processes = supervisor_,
      .record = monitor_.record(),
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

// Reports that everything is ready, or that the change of `last` has been done, and waits.
Instruction Run::next_instruction(Dialogue& dialogue, bool begun, milliseconds timeout,
                                  std::optional<msg::ControlRequest>& last) {
  msg::ControlReply reply;
  reply.accepted(true);
  reply.pending(!begun);
  reply.ready(!begun);
  apply_requests_.reply(begun ? *last : *conducted_, reply);
  const bool came =
      dialogue.wait_until([&] { return (last = apply_requests_.take_instruction()).has_value(); },
                          timeout + instruction_timeout);
  const bool withdraw = came && last->action() == msg::ControlAction::CONTROL_WITHDRAW;
  if (begun && (!came || withdraw)) return {Instruction::Kind::finish, ""};
  if (supervisor_.stopping()) return {Instruction::Kind::withdraw, "the deployment is stopping"};
  if (!came) return {Instruction::Kind::withdraw, "the requester did not confirm"};
  if (withdraw) return {Instruction::Kind::withdraw, withdrawn};
  if (last->change().empty()) return {Instruction::Kind::finish, ""};
  return {Instruction::Kind::change, last->change()};
}

void Run::answer(const msg::ControlRequest& request) {
  conducted_ = request.coordinated() ? &request : nullptr;
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

DeploymentFigures Run::figures() const {
  return run_figures(monitor_.record(), supervisor_, active_time_.seconds());
}

std::vector<std::string> Run::orderly_ended() const {
  std::vector<std::string> names;
  for (const ServiceConfig& service : composition_.deployment().services) {
    if (service.host == composition_.host() && service.has_process() && !service.external() &&
        supervisor_.figures(label(service)).phase == ProcessPhase::finished) {
      names.push_back(label(service));
    }
  }
  return names;
}

}  // namespace quoin::deploy
