// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace quoin::runtime {

/// Keeps a log short whatever happens: of messages that differ in their numbers alone the first ten
/// are written, then one now and then that says how many there were; and of all together no more
/// than a burst of 200 and one in ten seconds.
class LogLimit {
 public:
  using Clock = std::chrono::steady_clock;

  explicit LogLimit(std::function<Clock::time_point()> now = Clock::now) : now_(std::move(now)) {}

  /// The line to write for a message: one line of printable text of at most 1000 bytes, followed by
  /// what was left out before it. Nothing when the message is left out.
  [[nodiscard]] std::optional<std::string> line(std::string_view message);

 private:
  // Messages that differ in their numbers alone.
  struct Kind {
    std::uint64_t written = 0;
    std::uint64_t left_out = 0;  // since the last that was written
    Clock::time_point next;      // of which one is written
    Clock::time_point last;
  };
  [[nodiscard]] Kind& kind_of(std::string_view message, Clock::time_point now);
  [[nodiscard]] bool may_write(Clock::time_point now);

  std::function<Clock::time_point()> now_;
  std::map<std::string, Kind, std::less<>> kinds_;  // by text without numbers
  std::optional<double> allowance_;                 // [line]
  Clock::time_point allowed_at_;
  std::uint64_t left_out_ = 0;  // since the last line, for want of an allowance
};

/// Log to standard error, each line with the name of the service that it is about: that of the
/// innermost LogName of the thread, or `name`. Text of strangers is made printable, and repetitions
/// are left out: LogLimit.
void start_log(const std::string& name);

/// From now on an exception that nobody catches, in whatever thread, ends the process with a line
/// on standard error and exit code 1: mostly there is no memory left.
void report_uncaught_exceptions();

/// What an error says; of one that comes of missing memory, that it does.
[[nodiscard]] std::string failure_text(const std::exception& error);

/// While it lives, what this thread logs is about that service.
class LogName {
 public:
  explicit LogName(std::string name);
  ~LogName();
  LogName(const LogName&) = delete;
  LogName& operator=(const LogName&) = delete;

 private:
  std::string before_;
};

}  // namespace quoin::runtime
