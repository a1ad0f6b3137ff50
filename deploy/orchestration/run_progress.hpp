// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <optional>

#include "deploy/observation/deployment_record.hpp"
#include "deploy/observation/figures.hpp"
#include "deploy/orchestration/supervised_processes.hpp"

namespace quoin::deploy {

/// How long a deployment has been active: from when all its services were until it stops.
class ActiveTime {
 public:
  using Clock = std::chrono::steady_clock;
  enum class Event {
    none,
    active,  ///< all services are active now
    late,    ///< they are not, after 30 s
    over,    ///< the time to run is over
  };

  /// `duration`: [s] how long it is to be active; 0: no end.
  explicit ActiveTime(double duration, Clock::time_point begin = Clock::now())
      : duration_(duration), begin_(begin) {}

  /// What is new; `active` and `late` once each.
  [[nodiscard]] Event update(bool all_were_active, bool stopping, Clock::time_point now);
  /// [s] so far.
  [[nodiscard]] double seconds(Clock::time_point now = Clock::now()) const;
  /// [s] from the begin until all were active; 0 before that.
  [[nodiscard]] double start_seconds() const;

 private:
  double duration_;
  Clock::time_point begin_;
  std::optional<Clock::time_point> active_since_;
  std::optional<Clock::time_point> active_until_;
  bool late_ = false;
};

/// The figures of `record` with what is known of the processes: restarts, and the state of services
/// that cannot report it themselves. `duration` as ActiveTime has it.
[[nodiscard]] DeploymentFigures run_figures(const DeploymentRecord& record,
                                            const SupervisedProcesses& processes, double duration);

}  // namespace quoin::deploy
