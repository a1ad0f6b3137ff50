// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "deploy/orchestration/changeover.hpp"

#include <algorithm>
#include <set>
#include <stdexcept>

#include "deploy/orchestration/instruction.hpp"
#include "services/deployment/graph.hpp"

namespace quoin::deploy {

namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

// A scan that was on its way when its reader was matched may be missed; the next one is not.
constexpr seconds first_scan_timeout{2};
constexpr int no_process = 0;  // is no key

/// Whether a new process can wait, held, until the one before leaves its work to it.
bool can_be_held(const ServiceConfig& service) {
  return !service.external() && !service.info->exclusive;
}

std::vector<std::string> topics_of(const ServiceConfig& service) {
  std::vector<std::string> topics;
  for (const OutputConfig& output : service.outputs) topics.push_back(output.topic);
  return topics;
}

/// The plan with more readers to wait for, publishing only when instructed to.
ProcessPlan held_plan(ProcessPlan plan, const std::map<std::string, int>& more_readers) {
  for (const auto& [service, count] : more_readers) {
    plan.arguments.insert(plan.arguments.end(),
                          {"--observers", service + "=" + std::to_string(count)});
  }
  plan.arguments.emplace_back("--held");
  return plan;
}

/// A line of a service's log without time, name and level.
std::string message_of(const std::string& line) {
  const std::size_t at = line.find("] ");
  if (at == std::string::npos) return line;
  const std::size_t level = line.find(' ', at + 2);
  return level == std::string::npos ? line : line.substr(level + 1);
}

std::string in_seconds(milliseconds time) {
  return std::to_string(time.count() / 1000) + "." + std::to_string(time.count() % 1000 / 100) +
         " s";
}

}  // namespace

Changeover::Changeover(World world, const Deployment& running, const Deployment& wanted,
                       const Plan& plan, const Plan& elsewhere,
                       const std::vector<ProcessPlan>& plans, milliseconds timeout)
    : world_(std::move(world)),
      running_(running),
      wanted_(wanted),
      plan_(plan),
      elsewhere_(elsewhere),
      plans_(plans),
      timeout_(timeout) {}

void Changeover::prepare() {
  try {
    world_.record.add(wanted_);
    start_trials();
    wait_until_ready();
    swap_methods();
  } catch (const std::exception&) {
    roll_back();
    throw;
  }
}

// From here on a process that is started again works as wanted.
void Changeover::commit() {
  if (committed_) return;
  committed_ = true;
  for (const ProcessPlan& plan : plans_) {
    const bool replaced = std::ranges::any_of(plan_.changes, [&](const Change& change) {
      return change.action == ChangeAction::replace && plan.runs(change.service);
    });
    if (!replaced) world_.processes.replan(plan);
  }
}

void Changeover::change(const std::string& service) {
  commit();
  const auto change =
      std::find_if(plan_.changes.begin(), plan_.changes.end(),
                   [&](const Change& candidate) { return candidate.service == service; });
  if (change == plan_.changes.end() || !done_.insert(service).second) return;
  if (change->action == ChangeAction::stop) {
    stop_service(service);
    return;
  }
  if (change->action == ChangeAction::replace) hold_all();
  const auto trial = std::find_if(trials_.begin(), trials_.end(), [&](const Trial& candidate) {
    return candidate.change == &*change;
  });
  if (trial == trials_.end()) return;
  change->action == ChangeAction::start ? begin(*trial) : take_over(*trial);
}

void Changeover::finish() {
  commit();
  // Whoever reads is at work before the new source it reads begins.
  for (auto trial = trials_.rbegin(); trial != trials_.rend(); ++trial) {
    if (trial->change->action == ChangeAction::start) change(trial->change->service);
  }
  // From the sources on, so that what takes over gets its input from what took over before.
  for (const Trial& trial : trials_) change(trial.change->service);
  stop_removed();
  world_.record.confirm(wanted_);
}

void Changeover::start_trials() {
  for (const Change& change : plan_.changes) {
    if (change.action != ChangeAction::replace && change.action != ChangeAction::stop) continue;
    const auto key = world_.processes.key_of(change.service);
    if (!key) continue;
    const ProcessPlan& plan = world_.processes.plan(*key);
    predecessors_[change.service] = {*key, plan.level, plan.services};
  }
  std::map<std::string, int> keys;  // of the new processes, by name
  for (const Change& change : plan_.changes) {
    if (change.action != ChangeAction::start && change.action != ChangeAction::replace) continue;
    const auto plan = std::find_if(plans_.begin(), plans_.end(), [&](const ProcessPlan& candidate) {
      return candidate.runs(change.service);
    });
    const auto key = keys.find(plan->name);
    const int started = key == keys.end() ? start(*plan) : key->second;
    keys[plan->name] = started;
    trials_.push_back({&change, &wanted_.service(change.service), &*plan, started});
  }
}

int Changeover::start(const ProcessPlan& plan) {
  std::map<std::string, int> more_readers;
  bool held = true;
  for (const std::string& service : plan.services) {
    const ServiceConfig& config = wanted_.service(service);
    held = held && can_be_held(config);
    if (const int count = readers_to_go(config); count > 0) more_readers[service] = count;
  }
  if (held) return world_.processes.add(held_plan(plan, more_readers));
  // It has a device or a port of which there is only one.
  for (const std::string& service : plan.services) {
    const auto old = predecessors_.find(service);
    if (old == predecessors_.end()) continue;
    const int key = old->second.key;
    stopped_beforehand_.push_back(world_.processes.plan(key));
    stop({key});
    std::erase_if(predecessors_, [&](const auto& entry) { return entry.second.key == key; });
  }
  return world_.processes.add(plan);
}

// Readers of the present output that are still there, but not for long: they must not be taken for
// those that are waited for.
int Changeover::readers_to_go(const ServiceConfig& service) const {
  if (!plan_.replaces(label(service))) return 0;
  if (topics_of(running_.service(label(service))) != topics_of(service)) return 0;
  const Graph running(running_);
  int count = 0;
  for (const ServiceConfig* reader : running.readers_of(service.name)) {
    const auto inputs = running.inputs_of(*reader);
    const auto readers = std::count_if(inputs.begin(), inputs.end(), [&](const Connection& input) {
      return input.writer->name == service.name && !share_memory(*input.writer, *reader);
    });
    if (elsewhere_.replaces(label(*reader)) || elsewhere_.stops(label(*reader))) {
      count += static_cast<int>(readers);
    }
    if (!plan_.replaces(label(*reader)) && !plan_.stops(label(*reader))) continue;
    const auto key = world_.processes.key_of(label(*reader));
    if (key && world_.processes.running(*key)) count += static_cast<int>(readers);
  }
  return count;
}

void Changeover::wait_until_ready() {
  const auto deadline = world_.dialogue.now() + timeout_;
  std::set<std::string> waiting;
  for (const Trial& trial : trials_) waiting.insert(label(*trial.config));
  while (!waiting.empty()) {
    for (Trial& trial : trials_) {
      const std::string& name = label(*trial.config);
      if (!waiting.contains(name)) continue;
      if (const auto end = world_.processes.end_of_trial(trial.key)) {
        const std::string line = message_of(world_.last_line(trial.plan->name));
        throw std::runtime_error("the new process of service '" + name + "' ended with " +
                                 describe(*end) + (line.empty() ? "" : ": " + line));
      }
      if (ready(trial)) waiting.erase(name);
      if (!waiting.empty() && world_.dialogue.now() > deadline) {
        throw std::runtime_error(why_not_ready(trial));
      }
    }
    if (!world_.dialogue.pump()) throw std::runtime_error("the deployment is stopping");
    if (world_.withdrawn()) throw std::runtime_error(withdrawn);
  }
  // No request is lost from the first answer on.
  for (const auto& [name, predecessor] : predecessors_) {
    const int key = predecessor.key;
    if (!world_.processes.running(key)) continue;  // nobody to wait for
    if (!world_.dialogue.ask(name, incarnation_of(name, key),
                             msg::ControlAction::CONTROL_DESCRIBE)) {
      throw std::runtime_error("the running process of service '" + name +
                               "' does not answer; it is process " +
                               std::to_string(world_.processes.process_id(key)));
    }
  }
}

bool Changeover::ready(Trial& trial) {
  if (trial.config->external()) return world_.processes.running(trial.key);
  const auto process =
      world_.record.process(label(*trial.config), world_.processes.process_id(trial.key));
  if (!process) return false;
  if (!can_be_held(*trial.config)) return process->state == msg::ServiceState::STATE_ACTIVE;
  if (process->state != msg::ServiceState::STATE_HELD) return false;
  trial.incarnation = process->incarnation;
  return world_.dialogue
      .ask(label(*trial.config), trial.incarnation, msg::ControlAction::CONTROL_DESCRIBE)
      .has_value();
}

// In a process of ours, should there be others of that name; 0 when nothing was heard of it, or it
// is gone.
std::uint64_t Changeover::incarnation_of(const std::string& service, int key) const {
  if (!world_.processes.running(key)) return 0;
  const auto process = world_.record.process(service, world_.processes.process_id(key));
  return process ? process->incarnation : 0;
}

std::string Changeover::why_not_ready(const Trial& trial) const {
  const std::string& name = label(*trial.config);
  const auto process = world_.record.process(name, world_.processes.process_id(trial.key));
  std::string text =
      "the new process of service '" + name + "' was not ready within " + in_seconds(timeout_);
  if (!process) return text + ": nothing was heard of it";
  return process->detail.empty() ? text : text + ": " + process->detail;
}

void Changeover::swap_methods() {
  for (const Change& change : plan_.changes) {
    if (change.action != ChangeAction::swap) continue;
    const Dialogue::Swap swap = world_.dialogue.swap(wanted_.service(change.service));
    if (!swap.refusal.empty()) {
      throw std::runtime_error("service '" + change.service + "' " + swap.refusal);
    }
    if (swap.first_scan) first_scans_[change.service] = *swap.first_scan;
    swapped_.push_back(change.service);
  }
}

void Changeover::roll_back() {
  for (const std::string& name : swapped_) (void)world_.dialogue.swap(running_.service(name));
  first_scans_.clear();
  std::set<int> keys;
  for (const Trial& trial : trials_) keys.insert(trial.key);
  std::map<int, int> process_ids;
  for (const int key : keys) process_ids[key] = world_.processes.process_id(key);
  for (const int key : keys) stop({key});
  for (const Trial& trial : trials_) {
    world_.record.forget(label(*trial.config), process_ids[trial.key]);
  }
  for (const ProcessPlan& plan : stopped_beforehand_) {
    const int key = world_.processes.add(plan);
    world_.processes.adopt(key, plan);
  }
  world_.record.confirm(running_);
}

/// Whoever takes over from a process that reads the same scans keeps them from now on: what runs
/// beside it in one process hears nobody else once its neighbour has been replaced.
void Changeover::hold_all() {
  for (Trial& trial : trials_) {
    const std::string name = label(*trial.config);
    const auto predecessor = predecessors_.find(name);
    const bool takes_over = trial.change->same_scans && predecessor != predecessors_.end() &&
                            world_.processes.running(predecessor->second.key) &&
                            trial.change->action == ChangeAction::replace;
    if (!takes_over || trial.held || trial.config->is_source()) continue;
    trial.held = hold(trial, first_scan_timeout);
  }
}

void Changeover::begin(const Trial& trial) {
  if (!can_be_held(*trial.config)) {
    world_.processes.adopt(trial.key, *trial.plan);
    return;
  }
  const msg::ControlReply held = hold(trial, milliseconds(0));
  if (held.held_scans() > 0 || trial.config->is_source()) {
    first_scans_[label(*trial.config)] = held.first_sequence_number();
  }
  begin_with(trial, {});
}

void Changeover::take_over(const Trial& trial) {
  const std::string name = label(*trial.config);
  const auto predecessor = predecessors_.find(name);
  const int key = predecessor == predecessors_.end() ? no_process : predecessor->second.key;
  if (!world_.processes.running(key)) {
    world_.processes.retire(key, false);  // nor is it started again
    begin(trial);
    return;
  }
  const bool same_scans = trial.change->same_scans;
  const bool source = trial.config->is_source();
  const msg::ControlReply held =
      trial.held ? *trial.held : hold(trial, source ? seconds(0) : first_scan_timeout);
  // Each of its services may take its time.
  world_.processes.retire(key, false, predecessor->second.services.size());
  std::optional<msg::ControlReply> handed_over;
  // Without it the new process would hear what is meant for the old one.
  if (const std::uint64_t incarnation = incarnation_of(name, key); incarnation != 0) {
    msg::ControlRequest leave;
    leave.action(msg::ControlAction::CONTROL_HAND_OVER);
    if (same_scans) leave.positions(held.positions());
    handed_over = world_.dialogue.ask(name, incarnation, std::move(leave));
  }
  msg::ControlRequest take;  // everything that is held
  if (handed_over && handed_over->accepted()) {
    if (same_scans) take.positions(handed_over->positions());
    take.state(handed_over->state());
  } else {
    world_.processes.kill(key);
    world_.dialogue.wait_until([&] { return !world_.processes.running(key); }, seconds(5));
  }
  first_scans_[name] = same_scans && !take.positions().empty()
                           ? take.positions().front().sequence_number()
                           : held.first_sequence_number();
  begin_with(trial, std::move(take));
}

msg::ControlReply Changeover::hold(const Trial& trial, milliseconds timeout) {
  const auto deadline = world_.dialogue.now() + timeout;
  while (true) {
    const auto reply = world_.dialogue.ask(label(*trial.config), trial.incarnation,
                                           msg::ControlAction::CONTROL_HOLD);
    if (!reply) return {};
    if (reply->held_scans() > 0 || world_.dialogue.now() >= deadline) return *reply;
    if (!world_.dialogue.pump()) return *reply;
  }
}

void Changeover::begin_with(const Trial& trial, msg::ControlRequest take) {
  world_.processes.adopt(trial.key, *trial.plan);
  take.action(msg::ControlAction::CONTROL_TAKE_OVER);
  const auto reply = world_.dialogue.ask(label(*trial.config), trial.incarnation, std::move(take));
  // Started again it works like any other.
  const bool begun = reply && reply->accepted();
  if (!begun && !world_.processes.stopping()) world_.processes.kill(trial.key);
}

void Changeover::stop_removed() {
  std::map<int, std::vector<std::string>> levels;
  for (const Change& change : plan_.changes) {
    if (change.action != ChangeAction::stop || done_.contains(change.service)) continue;
    const auto key = predecessors_.find(change.service);
    if (key == predecessors_.end()) continue;
    const int level =
        std::max(Graph(running_).level(running_.service(change.service)), key->second.level);
    levels[level].push_back(change.service);
  }
  for (const auto& [level, services] : levels) {
    for (const std::string& service : services) stop_service(service);
  }
}

/// With its process, unless others of it go on or leave their work to a successor.
void Changeover::stop_service(const std::string& service) {
  const auto predecessor = predecessors_.find(service);
  if (predecessor == predecessors_.end()) return;
  const int key = predecessor->second.key;
  const bool whole = std::ranges::all_of(
      predecessor->second.services, [&](const std::string& other) { return plan_.stops(other); });
  if (whole) {
    // Dead or alive: a dead one is not started again.
    stop({key});
    std::erase_if(predecessors_, [&](const auto& entry) { return entry.second.key == key; });
  } else if (world_.processes.running(key)) {
    (void)world_.dialogue.ask(service, incarnation_of(service, key),
                              msg::ControlAction::CONTROL_STOP);
  }
}

void Changeover::stop(const std::vector<int>& keys) {
  for (const int key : keys) world_.processes.retire(key, true);
  for (const int key : keys) {
    // Killed after five seconds.
    world_.dialogue.wait_until([&] { return !world_.processes.running(key); }, seconds(10));
  }
}

}  // namespace quoin::deploy
