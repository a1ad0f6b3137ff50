// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <sys/types.h>
#include <vector>

namespace quoin::deploy {

/// How a process ended.
struct ProcessEnd {
  bool by_signal = false;
  int value = 0;  ///< exit code or signal

  [[nodiscard]] bool exited_with(int code) const { return !by_signal && value == code; }
};

/// "exit code 1" or "signal 9 (Killed)".
[[nodiscard]] std::string describe(const ProcessEnd& end);

/// A child process in a process group of its own, which gets SIGTERM when this process dies. Its
/// standard output and error arrive here line by line; its standard input is empty.
///
/// Start processes from one thread that lives as long as they shall: the kernel ties the signal at
/// our death to the thread that started the child.
class Process {
 public:
  /// Throws std::system_error when no process can be started. A program that cannot be executed
  /// ends with exit code 127 and says why in its output.
  Process(const std::filesystem::path& program, const std::vector<std::string>& arguments);
  /// Kills the process if it still runs.
  ~Process();
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  /// Processes that are started from now on keep this open, so that others see whether they live;
  /// -1: nothing.
  static void keep_open(int descriptor);

  [[nodiscard]] pid_t pid() const { return pid_; }
  /// To poll for reading: ready when the process has ended.
  [[nodiscard]] int end_descriptor() const { return end_descriptor_; }
  /// To poll for reading: ready when there is output; -1 when it has been closed.
  [[nodiscard]] int output_descriptor() const { return output_descriptor_; }

  /// Hands complete lines to `sink` without waiting for more.
  void read_output(const std::function<void(const std::string&)>& sink);
  /// The end of the process and of whatever it left in its group; nothing while it runs. Call no
  /// other function but read_output afterwards.
  [[nodiscard]] std::optional<ProcessEnd> reap();
  void send_signal(int signal) const;

 private:
  pid_t pid_ = -1;
  int end_descriptor_ = -1;
  int output_descriptor_ = -1;
  std::string partial_line_;
};

}  // namespace quoin::deploy
