// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace quoin::runtime {

/// Log to standard error, each line with the name of the service that it is about: that of the
/// innermost LogName of the thread, or `name`.
void start_log(const std::string& name);

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
