// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "deploy/observation/deployment_record.hpp"

#include <algorithm>
#include <utility>

#include "deploy/observation/heartbeats.hpp"
#include "services/deployment/graph.hpp"
#include "services/runtime/node/clock.hpp"

namespace quoin::deploy {

DeploymentRecord::DeploymentRecord(const Deployment& deployment, std::string host, OnEnd on_end)
    : host_(std::move(host)), on_end_(std::move(on_end)) {
  add(deployment, false);
  confirm(deployment);
}

void DeploymentRecord::add(const Deployment& wanted) { add(wanted, true); }

void DeploymentRecord::add(const Deployment& wanted, bool joined_late) {
  const std::vector<Connection> ends = Graph(wanted).ends();
  std::unique_lock lock(mutex_);
  for (const ServiceConfig& service : wanted.services) {
    if (service.external()) continue;
    const auto [watch, added] = services_.try_emplace(label(service));
    if (!added) continue;
    watch->second.name = service.name;
    watch->second.local = service.host == host_;
    order_.push_back(label(service));
  }
  for (const Connection& end : new_ends(ends)) {
    const auto of_service = std::count_if(ends.begin(), ends.end(), [&](const Connection& other) {
      return other.writer == end.writer;
    });
    ends_.emplace_back(end, end.writer->name + (of_service > 1 ? "/" + end.type : ""), joined_late);
    const std::size_t number = ends_.size() - 1;
    // Who listens may be about to deliver.
    lock.unlock();
    try {
      on_end_(number, end);
    } catch (...) {
      lock.lock();
      ends_.pop_back();
      throw;
    }
    lock.lock();
  }
}

std::vector<Connection> DeploymentRecord::new_ends(const std::vector<Connection>& ends) const {
  std::vector<Connection> added;
  for (const Connection& end : ends) {
    const bool known = std::any_of(ends_.begin(), ends_.end(), [&](const EndWatch& watch) {
      return watch.service() == end.writer->name && watch.type() == end.type;
    });
    if (!known && end.writer->host == host_) added.push_back(end);
  }
  return added;
}

void DeploymentRecord::confirm(const Deployment& deployment) {
  const std::lock_guard lock(mutex_);
  file_ = deployment.file.string();
  std::vector<std::string> order;
  for (auto& [name, watch] : services_) watch.present = false;
  for (const ServiceConfig& service : deployment.services) {
    if (service.external()) continue;
    ServiceWatch& watch = services_.at(label(service));
    watch.kind = service.kind;
    watch.local = service.host == host_;
    watch.source = service.is_source();
    watch.outputs = service.outputs;
    if (!service.outputs.empty()) watch.incarnations.set_topic(service.outputs.front().topic);
    watch.present = true;
    if (!watch.confirmed) watch.method = service.method;
    watch.confirmed = true;
    order.push_back(label(service));
  }
  std::erase_if(services_, [](const auto& entry) { return !entry.second.confirmed; });
  for (const std::string& name : order_) {
    const auto known = services_.find(name);
    if (known != services_.end() && !known->second.present) order.push_back(name);
  }
  order_ = std::move(order);
  const Graph graph(deployment);
  const std::vector<Connection> ends = graph.ends();
  for (EndWatch& watch : ends_) {
    const auto end = std::find_if(ends.begin(), ends.end(), [&](const Connection& candidate) {
      return candidate.writer->name == watch.service() && candidate.type == watch.type();
    });
    if (end != ends.end() && is_present(watch.service())) {
      watch.set_path(graph.path_to(*end->writer, end->output));
    } else {
      watch.interrupt();
    }
  }
}

// Whether the newest process has reported its end.
bool DeploymentRecord::ended(const ServiceWatch& watch) {
  if (watch.processes.empty()) return false;
  const msg::ServiceState state = watch.processes.rbegin()->second.state;
  return state != msg::STATE_STARTING && state != msg::STATE_HELD && state != msg::STATE_ACTIVE;
}

// Whether any instance of the name is part of this host's share now.
bool DeploymentRecord::is_present(const std::string& name) const {
  return std::any_of(services_.begin(), services_.end(), [&](const auto& entry) {
    return entry.second.name == name && entry.second.local && entry.second.present;
  });
}

std::optional<ProcessWatch> DeploymentRecord::process(const std::string& name,
                                                      int process_id) const {
  const std::lock_guard lock(mutex_);
  const auto service = services_.find(name);
  if (service == services_.end()) return std::nullopt;
  for (const auto& [incarnation, watch] : service->second.processes) {
    if (watch.process_id == process_id) return watch;
  }
  return std::nullopt;
}

void DeploymentRecord::forget(const std::string& name, int process_id) {
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

bool DeploymentRecord::removed(const std::string& name) const {
  const std::lock_guard lock(mutex_);
  return !services_.at(name).present;
}

void DeploymentRecord::receive(const msg::ServiceStatus& status) {
  const std::lock_guard lock(mutex_);
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
  if (status.incarnation() >= watch.method_of) {
    watch.method = status.method();
    watch.method_of = status.incarnation();
  }
  watch.was_active = watch.was_active || status.state() != msg::STATE_STARTING;
}

void DeploymentRecord::receive(std::size_t end, const msg::Header& header,
                               const EndMessage& message) {
  const std::lock_guard lock(mutex_);
  EndWatch& watch = ends_.at(end);
  if (watch.receive(header, message)) note_published(watch, header);
}

// The instance that wrote an entry of a trace; null when there are several and it has not reported
// its incarnation yet.
DeploymentRecord::ServiceWatch* DeploymentRecord::writer_of(const msg::StageTrace& trace) {
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

// Heartbeats come once a second; the trace shows at once what a process had published, which is all
// there is when it is killed.
void DeploymentRecord::note_published(const EndWatch& watch, const msg::Header& header) {
  for (const msg::StageTrace& trace : header.trace()) {
    ServiceWatch* service = writer_of(trace);
    if (service == nullptr) continue;
    service->incarnations.published_at_least(trace.incarnation(), watch.topic_of(trace.service()),
                                             trace.index() + 1);
  }
}

bool DeploymentRecord::knows(const std::string& name) const {
  const std::lock_guard lock(mutex_);
  return services_.contains(name);
}

bool DeploymentRecord::was_active(const std::string& name) const {
  const std::lock_guard lock(mutex_);
  const auto service = services_.find(name);
  return service != services_.end() && service->second.was_active;
}

bool DeploymentRecord::have_ended(const std::vector<std::string>& names) const {
  const std::lock_guard lock(mutex_);
  return std::all_of(names.begin(), names.end(),
                     [&](const std::string& name) { return ended(services_.at(name)); });
}

std::string DeploymentRecord::never_active() const {
  const std::lock_guard lock(mutex_);
  std::string names;
  for (const auto& [name, watch] : services_) {
    if (watch.was_active || !watch.local || !watch.present) continue;
    names += (names.empty() ? "" : ", ") + name;
    const std::string detail = watch.incarnations.total().detail;
    if (!detail.empty()) names += " (" + detail + ")";
  }
  return names;
}

std::map<std::string, std::set<int>> DeploymentRecord::processes() const {
  const std::lock_guard lock(mutex_);
  std::map<std::string, std::set<int>> processes;
  for (const auto& [name, watch] : services_) {
    if (!watch.local) continue;
    for (const auto& [incarnation, process] : watch.processes) {
      processes[name].insert(process.process_id);
    }
  }
  return processes;
}

// Of all hosts: of each output that numbers its messages, by the processes of each instance.
std::vector<SourceInstance> DeploymentRecord::source_instances() const {
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
      for (const EndWatch& end : ends_) {
        if (end.source_type() == output.type) accounts.push_back(&end.sources());
      }
      instance.ledger.learn(accounts);
    }
  }
  return instances;
}

DeploymentFigures DeploymentRecord::figures() const {
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
    if (!watch.confirmed) continue;
    ServiceFigures entry{name, watch.kind, watch.method, watch.incarnations.total(), 0};
    entry.numbered = numbered[name];
    if (watch.source) {
      entry.report.published = entry.numbered[watch.outputs.front().type];
      figures.scans_published += entry.report.published;
    } else {
      // What a killed process received after its last heartbeat shows in its results alone.
      entry.report.received = std::max(entry.report.received, entry.report.published);
    }
    if (watch.local) figures.services.push_back(std::move(entry));
  }
  for (const EndWatch& watch : ends_) {
    const bool was_there = std::any_of(services_.begin(), services_.end(), [&](const auto& entry) {
      return entry.second.name == watch.service();
    });
    if (was_there) figures.ends.push_back(watch.figures(sources));
  }
  return figures;
}

void DeploymentRecord::close() {
  const std::lock_guard lock(mutex_);
  for (EndWatch& watch : ends_) {
    if (!is_present(watch.service())) continue;
    const ServiceWatch* source = watch.heard_nothing() ? nullptr : writer_of(watch.source_trace());
    // A source on another host that goes on without us: its further scans are no loss.
    if (source != nullptr && !source->local && !ended(*source)) continue;
    watch.end();
  }
}

}  // namespace quoin::deploy
