// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace quoin::runtime {

/// Log to standard error, each line with the name of the service that it is about: that of the
/// innermost LogName of the thread, or `name`. Text of strangers is made printable, and repetitions
/// are left out: LogLimit.
void start_log(const std::string& name);

/// From now on an exception that nobody catches, in whatever thread, ends the process with a line
/// on standard error and exit code 1: mostly there is no memory left.
void report_uncaught_exceptions();

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
