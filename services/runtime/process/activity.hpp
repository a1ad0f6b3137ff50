// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <string>

#include "services/deployment/deployment.hpp"
#include "services/runtime/process/run_process.hpp"

namespace quoin::runtime {

/// What the body of a service works with that reads no topic. Ends in order on SIGTERM or SIGINT.
/// All functions may be called from any thread.
class Activity {
 public:
  virtual ~Activity() = default;

  /// Waits until `time`; false at once when the service is asked to stop.
  [[nodiscard]] virtual bool wait_until(std::chrono::steady_clock::time_point time) = 0;

  /// Shown in the status heartbeat and the log, such as "2 malformed lines skipped".
  virtual void warn(const std::string& text) = 0;

  /// Written to the log; takes the last warning back from the heartbeat.
  virtual void clear_warning(const std::string& text) = 0;

  /// An entry of the heartbeat; replaces the value of that name.
  virtual void set_diagnostic(const std::string& name, const std::string& value) = 0;
};

/// Opens what the body works on and returns the body, which works with a `Context`: Activity or
/// derived from it. Exceptions from opening are start-up errors (exit code 2).
template <class Context>
using BodyFactory = std::function<std::function<void(Context&)>(
    const ServiceConfig&, const std::filesystem::path& base_directory)>;

using ActivityFactory = BodyFactory<Activity>;

/// A kind without topics of data. The body returns when it is done, or when `wait_until` says
/// false.
[[nodiscard]] Component activity_component(const KindInfo& kind, ActivityFactory open);

}  // namespace quoin::runtime
