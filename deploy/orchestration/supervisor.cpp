// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "deploy/orchestration/supervisor.hpp"

#include <algorithm>
#include <signal.h>
#include <stdexcept>

#include "services/deployment/deployment.hpp"

namespace quoin::deploy {

namespace {
using std::chrono::milliseconds;
constexpr milliseconds timeout{5000};  // from SIGTERM to SIGKILL

std::string seconds_text(milliseconds time) {
  return std::to_string(time.count() / 1000) + "." + std::to_string(time.count() % 1000 / 100) +
         " s";
}
}  // namespace

bool ProcessPlan::runs(const std::string& service) const {
  return name == service || std::ranges::find(services, service) != services.end();
}

Supervisor::Supervisor(std::vector<ProcessPlan> plans, Callbacks callbacks)
    : callbacks_(std::move(callbacks)) {
  for (ProcessPlan& plan : plans) insert(std::move(plan));
}

Supervisor::Child& Supervisor::insert(ProcessPlan plan) {
  Child& child = children_.emplace_back();
  child.key = ++last_key_;
  child.plan = std::move(plan);
  return child;
}

Supervisor::Child* Supervisor::known(int key) {
  const auto found = std::ranges::find(children_, key, &Child::key);
  return found == children_.end() ? nullptr : &*found;
}

Supervisor::Child& Supervisor::child(int key) {
  if (Child* found = known(key)) return *found;
  throw std::out_of_range("no process with key " + std::to_string(key));
}

const Supervisor::Child& Supervisor::child(int key) const {
  return const_cast<Supervisor*>(this)->child(key);
}

const Supervisor::Child* Supervisor::find(const std::string& name) const {
  const Child* found = nullptr;
  for (const Child& candidate : children_) {
    if (!candidate.plan.runs(name) || candidate.standing == Standing::trial) continue;
    if (found == nullptr || found->standing == Standing::retired) found = &candidate;
  }
  return found;
}

int Supervisor::add(ProcessPlan plan) {
  Child& added = insert(std::move(plan));
  added.standing = Standing::trial;
  try {
    launch(added);
  } catch (...) {
    children_.pop_back();
    throw;
  }
  return added.key;
}

void Supervisor::adopt(int key, ProcessPlan plan) {
  Child& adopted = child(key);
  adopted.standing = Standing::regular;
  adopted.first = false;  // it has proved itself
  adopted.plan = std::move(plan);
  if (!adopted.process && !stopping_) {
    adopted.figures.phase = ProcessPhase::pausing;  // died just before
    adopted.restart_at = Clock::now();
  }
}

void Supervisor::replan(ProcessPlan plan) {
  for (Child& planned : children_) {
    if (planned.standing == Standing::regular && planned.plan.name == plan.name) {
      planned.plan = plan;
    }
  }
}

void Supervisor::retire(int key, bool terminate, std::size_t services) {
  Child* const found = known(key);
  if (found == nullptr) return;
  Child& retired = *found;
  retired.never_adopted = retired.never_adopted || retired.standing == Standing::trial;
  retired.standing = Standing::retired;
  retired.asked_to_stop = true;
  if (!retired.process) {
    retired.figures.phase = ProcessPhase::finished;
    return;
  }
  if (terminate) retired.process->send_signal(SIGTERM);
  retired.kill_at = Clock::now() + timeout * static_cast<int>(std::max<std::size_t>(services, 1));
}

void Supervisor::kill(int key) {
  const Child* killed = known(key);
  if (killed != nullptr && killed->process) killed->process->send_signal(SIGKILL);
}

bool Supervisor::running(int key) const {
  return std::any_of(children_.begin(), children_.end(), [key](const Child& candidate) {
    return candidate.key == key && candidate.process;
  });
}

int Supervisor::process_id(int key) const { return child(key).figures.process_id; }

std::optional<ProcessEnd> Supervisor::end_of_trial(int key) const { return child(key).end; }

std::optional<int> Supervisor::key_of(const std::string& name) const {
  const Child* found = find(name);
  if (found == nullptr || found->standing == Standing::retired) return std::nullopt;
  return found->key;
}

void Supervisor::start() {
  for (Child& child : children_) launch(child);
}

void Supervisor::launch(Child& child) {
  std::vector<std::string> arguments = child.plan.arguments;
  if (child.figures.restarts > 0 && was_active(child)) {
    arguments.insert(arguments.end(), child.plan.again.begin(), child.plan.again.end());
  }
  child.process = std::make_unique<Process>(child.plan.program, arguments);
  child.started = Clock::now();
  child.figures.phase = ProcessPhase::running;
  child.figures.process_id = static_cast<int>(child.process->pid());
  started_.insert(child.figures.process_id);
}

bool Supervisor::poll(milliseconds timeout, int extra_descriptor) {
  // The list is made anew each time: it is short, and processes come and go.
  descriptors_.assign(1, pollfd{extra_descriptor, POLLIN, 0});
  for (const Child& child : children_) {
    if (!child.process) continue;
    descriptors_.push_back({child.process->end_descriptor(), POLLIN, 0});
    descriptors_.push_back({child.process->output_descriptor(), POLLIN, 0});
  }
  ::poll(descriptors_.data(), descriptors_.size(),
         static_cast<int>(time_to_next_action(timeout).count()));
  const bool extra_ready = (descriptors_.front().revents & POLLIN) != 0;
  for (Child& child : children_) collect(child);
  advance();
  forget_the_retired();
  return extra_ready;
}

bool Supervisor::was_active(const Child& child) const {
  if (child.plan.services.empty()) return callbacks_.was_active(child.plan.name);
  return std::ranges::all_of(child.plan.services, callbacks_.was_active);
}

// What is known of them goes to the account of the process that took their place. One that never
// had a place, or whose service is gone, leaves nothing but the latter's figures.
void Supervisor::forget_the_retired() {
  std::set<int> forgotten;
  for (const Child& retired : children_) {
    if (retired.standing != Standing::retired || retired.process) continue;
    const auto follows = [&](const Child& successor, const std::string& service) {
      return successor.standing == Standing::regular && successor.plan.runs(service);
    };
    std::vector<std::string> services = retired.plan.services;
    if (services.empty()) services.push_back(retired.plan.name);
    // Its services may go to several processes, one after the other.
    const bool all_go_on = std::ranges::all_of(services, [&](const std::string& service) {
      return std::ranges::any_of(
          children_, [&](const Child& successor) { return follows(successor, service); });
    });
    if (!retired.never_adopted && !all_go_on) continue;
    forgotten.insert(retired.key);
    if (retired.never_adopted) continue;
    for (Child& successor : children_) {
      if (std::ranges::any_of(
              services, [&](const std::string& service) { return follows(successor, service); })) {
        successor.figures.restarts += retired.figures.restarts;
      }
    }
  }
  std::erase_if(children_, [&](const Child& child) { return forgotten.contains(child.key); });
}

void Supervisor::collect(Child& child) {
  if (!child.process) return;
  const auto forward = [&](const std::string& line) { callbacks_.output(child.plan.name, line); };
  const std::optional<ProcessEnd> end = child.process->reap();
  child.process->read_output(forward);
  if (!end) return;
  child.process.reset();
  judge(child, *end);
}

void Supervisor::judge(Child& child, const ProcessEnd& end) {
  const bool proved = !child.first || was_active(child);
  child.first = false;
  // A process that was only just started has no handler for SIGTERM yet.
  if (child.standing == Standing::trial && !stopping_) {
    child.end = end;
    child.figures.phase = ProcessPhase::dead;
    return;
  }
  const bool orderly =
      end.exited_with(exit_ok) || (child.asked_to_stop && end.by_signal && end.value == SIGTERM);
  child.figures.phase = orderly ? ProcessPhase::finished : ProcessPhase::dead;
  if (child.standing == Standing::retired) {
    child.figures.phase = ProcessPhase::finished;
    if (!orderly) callbacks_.event(child.plan.name, "ended with " + describe(end));
  } else if (orderly) {
    if (!child.asked_to_stop && !child.plan.source) {
      callbacks_.event(child.plan.name, "ended by itself; not started again");
    }
  } else if (child.plan.source && end.exited_with(exit_input)) {
    callbacks_.event(child.plan.name, "its input became unusable; not started again");
    fail(exit_input);
  } else if (child.asked_to_stop) {
    callbacks_.event(child.plan.name, "ended with " + describe(end) + " while stopping");
    fail(exit_failure);
  } else if (end.exited_with(exit_configuration) && !proved) {
    callbacks_.event(child.plan.name, "cannot work with its configuration; stopping all");
    fail(exit_configuration);
    request_stop();
  } else {
    die(child, end);
  }
}

void Supervisor::die(Child& child, const ProcessEnd& end) {
  const auto lifetime = Clock::now() - child.started;
  std::string text = "process " + std::to_string(child.figures.process_id) + " died with " +
                     describe(end) + " after " +
                     seconds_text(std::chrono::duration_cast<milliseconds>(lifetime));
  if (stopping_) {
    // Its level is still to come, but nobody would wait for what a new process could do.
    callbacks_.event(child.plan.name, text);
    fail(exit_failure);
  } else if (child.plan.restart) {
    const milliseconds pause = std::max(child.plan.least_pause, child.backoff.next(lifetime));
    child.restart_at = Clock::now() + pause;
    child.figures.phase = ProcessPhase::pausing;
    callbacks_.event(child.plan.name, text + "; starting again in " + seconds_text(pause));
  } else {
    callbacks_.event(child.plan.name, text + "; stays dead (restart: never)");
    fail(exit_failure);
  }
}

void Supervisor::advance() {
  const auto now = Clock::now();
  if (stopping_) {
    stop_next_level(now);
    return;
  }
  kill_the_late(now);
  bool has_source = false;  // else somebody on another host decides when it is over
  bool source_left = false;
  for (Child& child : children_) {
    if (child.figures.phase == ProcessPhase::pausing && now >= child.restart_at) {
      ++child.figures.restarts;
      try {
        launch(child);
      } catch (const std::exception& error) {
        child.restart_at = now + child.backoff.next({});
        callbacks_.event(child.plan.name, std::string("cannot be started: ") + error.what());
      }
    }
    const bool failed_trial = child.standing == Standing::trial && child.end;
    if (child.standing == Standing::retired || failed_trial) continue;
    has_source = has_source || child.plan.source;
    source_left =
        source_left || (child.plan.source && (child.figures.phase == ProcessPhase::running ||
                                              child.figures.phase == ProcessPhase::pausing));
  }
  if (has_source && !source_left) request_stop();
}

void Supervisor::kill_the_late(Clock::time_point now) {
  for (Child& child : children_) {
    if (!child.process || now < child.kill_at) continue;
    child.kill_at = Clock::time_point::max();
    callbacks_.event(child.plan.name,
                     "did not stop within " + seconds_text(timeout) + "; killing it");
    child.process->send_signal(SIGKILL);
  }
}

void Supervisor::request_stop() {
  if (stopping_) return;
  stopping_ = true;
  for (Child& child : children_) {
    if (child.figures.phase == ProcessPhase::pausing) child.figures.phase = ProcessPhase::dead;
  }
  stop_next_level(Clock::now());
}

void Supervisor::stop_next_level(Clock::time_point now) {
  int lowest = -1;
  for (const Child& child : children_) {
    if (child.process && (lowest < 0 || child.plan.level < lowest)) lowest = child.plan.level;
  }
  if (lowest < 0) return;
  const bool new_level = lowest != level_;
  if (new_level) {
    level_ = lowest;
    level_deadline_ = now + timeout;
  } else if (now < level_deadline_) {
    return;
  } else {
    level_deadline_ = Clock::time_point::max();
  }
  for (Child& child : children_) {
    if (!child.process || child.plan.level != lowest) continue;
    if (new_level) {
      child.asked_to_stop = true;
      child.process->send_signal(SIGTERM);
    } else {
      callbacks_.event(child.plan.name,
                       "did not stop within " + seconds_text(timeout) + "; killing it");
      child.process->send_signal(SIGKILL);
    }
  }
}

void Supervisor::kill_all() {
  request_stop();
  for (Child& child : children_) {
    if (!child.process) continue;
    child.asked_to_stop = true;
    child.process->send_signal(SIGKILL);
  }
}

void Supervisor::fail(int code) {
  // A wrong configuration explains everything else; otherwise the first cause stands.
  if (exit_code_ == exit_ok || code == exit_configuration) exit_code_ = code;
}

bool Supervisor::ended() const {
  return stopping_ && std::none_of(children_.begin(), children_.end(),
                                   [](const Child& child) { return child.process != nullptr; });
}

ProcessFigures Supervisor::figures(const std::string& name) const {
  if (const Child* found = find(name)) return found->figures;
  throw std::out_of_range("no process of service '" + name + "'");
}

milliseconds Supervisor::time_to_next_action(milliseconds limit) const {
  const auto now = Clock::now();
  auto next = now + limit;
  for (const Child& child : children_) {
    if (child.figures.phase == ProcessPhase::pausing) next = std::min(next, child.restart_at);
    if (child.process && !stopping_) next = std::min(next, child.kill_at);
  }
  if (stopping_ && level_ >= 0) next = std::min(next, level_deadline_);
  // Rounded up: waking a little early would spin.
  return std::max(milliseconds(0), std::chrono::ceil<milliseconds>(next - now));
}

}  // namespace quoin::deploy
