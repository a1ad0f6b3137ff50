// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "deploy/orchestration/process.hpp"

#include <array>
#include <atomic>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <system_error>
#include <unistd.h>

namespace quoin::deploy {

namespace {

constexpr std::size_t longest_line = 8192;

std::atomic<int> kept_open{-1};

[[noreturn]] void throw_errno(const char* what) {
  throw std::system_error(errno, std::generic_category(), what);
}

/// Runs in the child between fork and exec, where other threads of the parent may have left any
/// lock taken: system calls only.
[[noreturn]] void become(char* const* arguments, int output, pid_t parent) {
  ::setpgid(0, 0);
  ::prctl(PR_SET_PDEATHSIG, SIGTERM);
  if (::getppid() != parent) ::_exit(127);  // the parent died before the line above
  const int nothing = ::open("/dev/null", O_RDONLY);
  if (nothing >= 0) ::dup2(nothing, STDIN_FILENO);
  ::dup2(output, STDOUT_FILENO);
  ::dup2(output, STDERR_FILENO);
  // Sockets of the parent's DDS participant must not stay open in the child.
  const bool kept = kept_open >= 0 && ::dup2(kept_open, 3) == 3;
  if (kept) ::fcntl(3, F_SETFD, 0);
  ::syscall(SYS_close_range, kept ? 4U : 3U, ~0U, 0U);
  // A log line into the pipe of a parent that died must not keep the child from an orderly end.
  ::signal(SIGPIPE, SIG_IGN);
  sigset_t none;
  ::sigemptyset(&none);
  ::sigprocmask(SIG_SETMASK, &none, nullptr);
  ::execv(arguments[0], arguments);
  constexpr char message[] = "cannot be executed; is it installed beside quoin?\n";
  [[maybe_unused]] const auto written = ::write(STDERR_FILENO, message, sizeof message - 1);
  ::_exit(127);
}

}  // namespace

std::string describe(const ProcessEnd& end) {
  if (!end.by_signal) return "exit code " + std::to_string(end.value);
  return "signal " + std::to_string(end.value) + " (" + ::strsignal(end.value) + ")";
}

void Process::keep_open(int descriptor) { kept_open = descriptor; }

Process::Process(const std::filesystem::path& program, const std::vector<std::string>& arguments) {
  const std::string program_text = program.string();
  std::vector<char*> pointers{const_cast<char*>(program_text.c_str())};
  for (const std::string& argument : arguments)
    pointers.push_back(const_cast<char*>(argument.c_str()));
  pointers.push_back(nullptr);

  std::array<int, 2> pipe{};
  if (::pipe2(pipe.data(), O_CLOEXEC) != 0) throw_errno("pipe2");
  ::fcntl(pipe[0], F_SETFL, O_NONBLOCK);
  const pid_t parent = ::getpid();
  pid_ = ::fork();
  if (pid_ == 0) become(pointers.data(), pipe[1], parent);
  ::close(pipe[1]);
  output_descriptor_ = pipe[0];
  if (pid_ < 0) {
    ::close(output_descriptor_);
    throw_errno("fork");
  }
  // Also here, so that the group exists whoever of the two runs first.
  ::setpgid(pid_, pid_);
  end_descriptor_ = static_cast<int>(::syscall(SYS_pidfd_open, pid_, 0));
  if (end_descriptor_ < 0) {
    const int error = errno;
    send_signal(SIGKILL);
    ::waitpid(pid_, nullptr, 0);
    ::close(output_descriptor_);
    errno = error;
    throw_errno("pidfd_open (Linux 5.3 or later is needed)");
  }
}

Process::~Process() {
  if (pid_ > 0) {
    send_signal(SIGKILL);
    ::waitpid(pid_, nullptr, 0);
  }
  if (end_descriptor_ >= 0) ::close(end_descriptor_);
  if (output_descriptor_ >= 0) ::close(output_descriptor_);
}

void Process::read_output(const std::function<void(const std::string&)>& sink) {
  std::array<char, 4096> buffer{};
  while (output_descriptor_ >= 0) {
    const ssize_t count = ::read(output_descriptor_, buffer.data(), buffer.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return;
    if (count == 0) {
      ::close(output_descriptor_);
      output_descriptor_ = -1;
      if (!partial_line_.empty()) sink(partial_line_);
      partial_line_.clear();
      return;
    }
    for (const char character : std::string_view(buffer.data(), static_cast<std::size_t>(count))) {
      if (character != '\n') partial_line_ += character;
      if (character == '\n' || partial_line_.size() >= longest_line) {
        sink(partial_line_);
        partial_line_.clear();
      }
    }
  }
}

std::optional<ProcessEnd> Process::reap() {
  siginfo_t information{};
  const auto id = static_cast<id_t>(pid_);
  if (::waitid(P_PID, id, &information, WEXITED | WNOHANG | WNOWAIT) != 0) throw_errno("waitid");
  if (information.si_pid == 0) return std::nullopt;
  // The unreaped leader keeps the number of the group from being used again.
  ::kill(-pid_, SIGKILL);
  ::waitid(P_PID, id, &information, WEXITED);
  pid_ = -1;
  return ProcessEnd{information.si_code != CLD_EXITED, information.si_status};
}

void Process::send_signal(int signal) const {
  if (pid_ > 0) ::kill(pid_, signal);
}

}  // namespace quoin::deploy
