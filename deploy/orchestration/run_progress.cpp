// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "deploy/orchestration/run_progress.hpp"

#include <string>

namespace quoin::deploy {

namespace {

constexpr std::chrono::seconds usual_start{30};

void add_process(const ProcessFigures& process, const DeploymentRecord& record,
                 ServiceFigures& service) {
  service.restarts = process.restarts;
  std::string& state = service.report.state;
  if (process.phase == ProcessPhase::pausing) {
    state = "restarting";
  } else if (process.phase == ProcessPhase::dead && state != "failed") {
    state = "dead";
  } else if (process.phase == ProcessPhase::running &&
             !record.process(service.name, process.process_id)) {
    state = "starting";  // nothing heard of the new process yet
  } else if (process.phase == ProcessPhase::finished && state != "stopped" && state != "failed") {
    state = "finished";  // in order, even if its last heartbeat was not heard
  }
  if (process.phase == ProcessPhase::pausing || process.phase == ProcessPhase::dead) {
    service.report.rate = 0.0;
  }
}

}  // namespace

ActiveTime::Event ActiveTime::update(bool all_were_active, bool stopping, Clock::time_point now) {
  if (stopping) {
    if (active_since_ && !active_until_) active_until_ = now;
    return Event::none;
  }
  if (!active_since_ && all_were_active) {
    active_since_ = now;
    return Event::active;
  }
  if (!active_since_ && !late_ && now - begin_ >= usual_start) {
    late_ = true;
    return Event::late;
  }
  return active_since_ && duration_ > 0.0 && seconds(now) >= duration_ ? Event::over : Event::none;
}

double ActiveTime::seconds(Clock::time_point now) const {
  if (!active_since_) return 0.0;
  return std::chrono::duration<double>(active_until_.value_or(now) - *active_since_).count();
}

double ActiveTime::start_seconds() const {
  return active_since_ ? std::chrono::duration<double>(*active_since_ - begin_).count() : 0.0;
}

DeploymentFigures run_figures(const DeploymentRecord& record, const SupervisedProcesses& processes,
                              double duration) {
  DeploymentFigures figures = record.figures();
  figures.duration = duration;
  for (ServiceFigures& service : figures.services) {
    if (record.removed(service.name)) {
      service.report.state = "removed";
      service.report.rate = 0.0;
      continue;
    }
    add_process(processes.figures(service.name), record, service);
    // The last heartbeat's rate is that of a fraction of a second.
    if (processes.ended() && duration > 0.0) {
      service.report.rate = static_cast<double>(service.report.published) / duration;
    }
  }
  return figures;
}

}  // namespace quoin::deploy
