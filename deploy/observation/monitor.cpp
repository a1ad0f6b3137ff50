// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "deploy/observation/monitor.hpp"

#include <algorithm>

#include "deploy/observation/heartbeats.hpp"
#include "services/deployment/graph.hpp"
#include "services/keys/key_files.hpp"
#include "services/runtime/dds/qos.hpp"
#include "services/runtime/node/clock.hpp"

namespace quoin::deploy {

namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;

}  // namespace

Monitor::Monitor(const Deployment& deployment, const std::string& host)
    : file_(deployment.file.string()),
      host_(host),
      participant_(runtime::participant_config(deployment, "quoin", operator_identity)),
      status_reader_(participant_, status_topic(deployment.name_space), runtime::QosPreset::state) {
  wait_set_.add(status_reader_);
  add(deployment, false);
  settle(deployment);
  thread_ = std::thread([this] { listen(); });
}

void Monitor::add(const Deployment& wanted) { add(wanted, true); }

void Monitor::add(const Deployment& wanted, bool joined_late) {
  const std::lock_guard lock(mutex_);
  for (const ServiceConfig& service : wanted.services) {
    if (service.external()) continue;
    const auto [watch, added] = services_.try_emplace(label(service));
    if (!added) continue;
    watch->second.name = service.name;
    watch->second.here = service.host == host_;
    order_.push_back(label(service));
  }
  listen_to_ends(wanted, joined_late);
}

void Monitor::listen_to_ends(const Deployment& deployment, bool joined_late) {
  const std::vector<Connection> ends = Graph(deployment).ends();
  for (const Connection& end : ends) {
    if (end.writer->host != host_) continue;
    const bool known = std::any_of(ends_.begin(), ends_.end(), [&](const auto& watch) {
      return watch->service() == end.writer->name && watch->type() == end.type;
    });
    if (known) continue;
    const auto of_service = std::count_if(ends.begin(), ends.end(), [&](const Connection& other) {
      return other.writer == end.writer;
    });
    ends_.push_back(std::make_unique<EndWatch>(
        participant_, end, end.writer->name + (of_service > 1 ? "/" + end.type : ""), joined_late));
    wait_set_.add(ends_.back()->reader());
  }
}

void Monitor::settle(const Deployment& deployment) {
  const std::lock_guard lock(mutex_);
  file_ = deployment.file.string();
  std::vector<std::string> order;
  for (auto& [name, watch] : services_) watch.present = false;
  for (const ServiceConfig& service : deployment.services) {
    if (service.external()) continue;
    ServiceWatch& watch = services_.at(label(service));
    watch.kind = service.kind;
    watch.here = service.host == host_;
    watch.source = service.is_source();
    watch.outputs = service.outputs;
    if (!service.outputs.empty()) watch.incarnations.set_topic(service.outputs.front().topic);
    watch.present = true;
    if (!watch.settled) watch.method = service.method;
    watch.settled = true;
    order.push_back(label(service));
  }
  std::erase_if(services_, [](const auto& entry) { return !entry.second.settled; });
  for (const std::string& name : order_) {
    const auto known = services_.find(name);
    if (known != services_.end() && !known->second.present) order.push_back(name);
  }
  order_ = std::move(order);
  const Graph graph(deployment);
  const std::vector<Connection> ends = graph.ends();
  for (const auto& watch : ends_) {
    const auto end = std::find_if(ends.begin(), ends.end(), [&](const Connection& candidate) {
      return candidate.writer->name == watch->service() && candidate.type == watch->type();
    });
    if (end != ends.end() && is_present(watch->service())) {
      watch->set_path(graph.path_to(*end->writer, end->output));
    } else {
      watch->interrupt();
    }
  }
}

// Whether the newest process has told that it ends.
bool Monitor::ended(const ServiceWatch& watch) {
  if (watch.processes.empty()) return false;
  const msg::ServiceState state = watch.processes.rbegin()->second.state;
  return state != msg::STATE_STARTING && state != msg::STATE_HELD && state != msg::STATE_ACTIVE;
}

// Whether any instance of the name is part of this host's share now.
bool Monitor::is_present(const std::string& name) const {
  return std::any_of(services_.begin(), services_.end(), [&](const auto& entry) {
    return entry.second.name == name && entry.second.here && entry.second.present;
  });
}

std::optional<ProcessWatch> Monitor::process(const std::string& name, int process_id) const {
  const std::lock_guard lock(mutex_);
  const auto service = services_.find(name);
  if (service == services_.end()) return std::nullopt;
  for (const auto& [incarnation, watch] : service->second.processes) {
    if (watch.process_id == process_id) return watch;
  }
  return std::nullopt;
}

void Monitor::forget(const std::string& name, int process_id) {
  const std::lock_guard lock(mutex_);
  forgotten_[process_id] = static_cast<std::uint64_t>(runtime::now_ns());
  const auto service = services_.find(name);
  if (service == services_.end()) return;
  std::erase_if(service->second.processes, [&](const auto& entry) {
    if (entry.second.process_id != process_id) return false;
    service->second.incarnations.forget(entry.first);
    return true;
  });
}

bool Monitor::removed(const std::string& name) const {
  const std::lock_guard lock(mutex_);
  return !services_.at(name).present;
}

Monitor::~Monitor() {
  ending_ = true;
  wait_set_.wake();
  if (thread_.joinable()) thread_.join();
}

void Monitor::listen() {
  while (!ending_) {
    wait_set_.wait(milliseconds(200));
    take_all();
    memory_trim_.tick();
  }
}

bool Monitor::take_all() {
  const std::lock_guard lock(mutex_);
  bool any = false;
  while (status_reader_.take(status_)) {
    take(status_);
    any = true;
  }
  for (const auto& watch : ends_) {
    any = watch->take_all([&](const msg::Header& header) { take_note_of(*watch, header); }) || any;
  }
  return any;
}

void Monitor::take(const msg::ServiceStatus& status) {
  const auto found = services_.find(status.service());
  if (found == services_.end()) return;
  const auto forgotten = forgotten_.find(static_cast<int>(status.pid()));
  if (forgotten != forgotten_.end() && status.incarnation() <= forgotten->second) return;
  ServiceWatch& watch = found->second;
  const ServiceReport report = report_of(status);
  watch.incarnations.update(status.incarnation(), report);
  watch.processes[status.incarnation()] = {static_cast<int>(status.pid()), status.incarnation(),
                                           status.state(), status.detail()};
  if (status.state() == msg::STATE_HELD) return;
  watch.method = status.method();
  watch.was_active = watch.was_active || status.state() != msg::STATE_STARTING;
}

// The instance that wrote an entry of a trace; null when there are several and it has not told its
// incarnation yet.
Monitor::ServiceWatch* Monitor::writer_of(const msg::StageTrace& trace) {
  ServiceWatch* only = nullptr;
  bool several = false;
  for (auto& [label, watch] : services_) {
    if (watch.name != trace.service()) continue;
    if (watch.processes.contains(trace.incarnation())) return &watch;
    several = only != nullptr;
    only = &watch;
  }
  return several ? nullptr : only;
}

// Heartbeats come once a second; the trace tells at once what a process had published, which is all
// there is when it is killed.
void Monitor::take_note_of(const EndWatch& watch, const msg::Header& header) {
  for (const msg::StageTrace& trace : header.trace()) {
    ServiceWatch* service = writer_of(trace);
    if (service == nullptr) continue;
    service->incarnations.published_at_least(trace.incarnation(), watch.topic_of(trace.service()),
                                             trace.index() + 1);
  }
}

bool Monitor::knows(const std::string& name) const {
  const std::lock_guard lock(mutex_);
  return services_.contains(name);
}

bool Monitor::was_active(const std::string& name) const {
  const std::lock_guard lock(mutex_);
  const auto service = services_.find(name);
  return service != services_.end() && service->second.was_active;
}

bool Monitor::all_were_active() const { return never_active().empty(); }

std::string Monitor::never_active() const {
  const std::lock_guard lock(mutex_);
  std::string names;
  for (const auto& [name, watch] : services_) {
    if (watch.was_active || !watch.here || !watch.present) continue;
    names += (names.empty() ? "" : ", ") + name;
    const std::string detail = watch.incarnations.total().detail;
    if (!detail.empty()) names += " (" + detail + ")";
  }
  return names;
}

std::map<std::string, std::set<int>> Monitor::processes() const {
  const std::lock_guard lock(mutex_);
  std::map<std::string, std::set<int>> processes;
  for (const auto& [name, watch] : services_) {
    if (!watch.here) continue;
    for (const auto& [incarnation, process] : watch.processes) {
      processes[name].insert(process.process_id);
    }
  }
  return processes;
}

int Monitor::newest_process(const std::string& name) const {
  const std::lock_guard lock(mutex_);
  const auto& processes = services_.at(name).processes;
  return processes.empty() ? 0 : processes.rbegin()->second.process_id;
}

// Of all hosts: of each output that numbers its messages, by the processes of each instance.
std::vector<SourceInstance> Monitor::source_instances() const {
  std::vector<SourceInstance> instances;
  for (const auto& [label, watch] : services_) {
    for (const OutputConfig& output : watch.outputs) {
      const bool scans = watch.source && &output == &watch.outputs.front();
      if (!scans && output.rate == Rate::per_input) continue;
      SourceInstance& instance =
          instances.emplace_back(SourceInstance{label, watch.name, output.type, {}});
      for (const auto& [incarnation, process] : watch.incarnations.processes()) {
        const auto counts = process.outputs.find(output.topic);
        if (scans) {
          instance.ledger.add(incarnation, {process.first_number, process.published, process.lost});
        } else if (counts != process.outputs.end()) {
          instance.ledger.add(incarnation, {0, counts->second.published, counts->second.lost});
        }
      }
      std::vector<const std::vector<runtime::SourceAccount>*> accounts;
      for (const auto& end : ends_) {
        if (end->source_type() == output.type) accounts.push_back(&end->sources());
      }
      instance.ledger.learn(accounts);
    }
  }
  return instances;
}

DeploymentFigures Monitor::figures() const {
  const std::lock_guard lock(mutex_);
  const std::vector<SourceInstance> sources = source_instances();
  std::map<std::string, std::map<std::string, std::uint64_t>> numbered;  // by label and type
  for (const SourceInstance& source : sources) {
    numbered[source.label][source.type] = source.ledger.published();
  }
  DeploymentFigures figures;
  figures.deployment = file_;
  for (const std::string& name : order_) {
    const ServiceWatch& watch = services_.at(name);
    if (!watch.settled) continue;
    ServiceFigures entry{name, watch.kind, watch.method, watch.incarnations.total(), 0};
    entry.numbered = numbered[name];
    if (watch.source) {
      entry.report.published = entry.numbered[watch.outputs.front().type];
      figures.scans_published += entry.report.published;
    } else {
      // What a killed process received after its last heartbeat shows in its results alone.
      entry.report.received = std::max(entry.report.received, entry.report.published);
    }
    if (watch.here) figures.services.push_back(std::move(entry));
  }
  for (const auto& watch : ends_) {
    const bool was_there = std::any_of(services_.begin(), services_.end(), [&](const auto& entry) {
      return entry.second.name == watch->service();
    });
    if (was_there) figures.ends.push_back(watch->figures(sources));
  }
  return figures;
}

void Monitor::finish(const std::vector<std::string>& names, milliseconds timeout) {
  const auto all_ended = [&] {
    const std::lock_guard lock(mutex_);
    for (const std::string& name : names) {
      if (!ended(services_.at(name))) return false;
    }
    return true;
  };
  const auto deadline = steady_clock::now() + timeout;
  while (!all_ended() && steady_clock::now() < deadline) {
    std::this_thread::sleep_for(milliseconds(5));
  }
  ending_ = true;
  wait_set_.wake();
  thread_.join();
  take_all();
  account_for_the_end();
}

void Monitor::account_for_the_end() {
  const std::lock_guard lock(mutex_);
  for (const auto& watch : ends_) {
    if (!is_present(watch->service())) continue;
    const ServiceWatch* source =
        watch->heard_nothing() ? nullptr : writer_of(watch->source_trace());
    // A source on another host that goes on without us: its further scans are no loss.
    if (source != nullptr && !source->here && !ended(*source)) continue;
    watch->end();
  }
}

}  // namespace quoin::deploy
