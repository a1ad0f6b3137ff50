// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "deploy/bundle/captured_run.hpp"

#include <array>
#include <csignal>
#include <cstring>
#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

extern char** environ;  // NOLINT: POSIX has no header for it

namespace quoin::deploy {

namespace {

constexpr std::size_t most_bytes = 4 << 20;  // that are kept of what a program prints

/// Reads until the program has closed its end, or `longest` has passed. Returns whether it has.
bool read_all(int descriptor, std::chrono::milliseconds longest, std::string& text) {
  const auto deadline = std::chrono::steady_clock::now() + longest;
  std::array<char, 65536> part{};
  while (true) {
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(
        deadline - std::chrono::steady_clock::now());
    if (left.count() <= 0) return false;
    pollfd waiting{descriptor, POLLIN, 0};
    if (::poll(&waiting, 1, static_cast<int>(left.count())) <= 0) continue;
    const ssize_t got = ::read(descriptor, part.data(), part.size());
    if (got <= 0) return true;
    if (text.size() < most_bytes) text.append(part.data(), static_cast<std::size_t>(got));
  }
}

}  // namespace

std::string captured_run(const std::vector<std::string>& words, std::chrono::milliseconds longest) {
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) return "(no pipe)\n";
  std::vector<std::string> copies = words;
  std::vector<char*> arguments;
  for (std::string& word : copies) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t actions{};
  ::posix_spawn_file_actions_init(&actions);
  ::posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  ::posix_spawn_file_actions_adddup2(&actions, ends[1], STDOUT_FILENO);
  ::posix_spawn_file_actions_adddup2(&actions, ends[1], STDERR_FILENO);
  pid_t process = 0;
  const int failed =
      ::posix_spawnp(&process, arguments[0], &actions, nullptr, arguments.data(), environ);
  ::posix_spawn_file_actions_destroy(&actions);
  ::close(ends[1]);
  std::string text;
  if (failed != 0) {
    ::close(ends[0]);
    return "(" + words.front() + " cannot be started: " + std::strerror(failed) + ")\n";
  }
  const bool ended = read_all(ends[0], longest, text);
  ::close(ends[0]);
  if (!ended) ::kill(process, SIGKILL);
  int status = 0;
  ::waitpid(process, &status, 0);
  if (!ended) {
    text += "(stopped after " + std::to_string(longest.count()) + " ms)\n";
  } else if (WIFEXITED(status) && WEXITSTATUS(status) != 0) {
    text += "(exit code " + std::to_string(WEXITSTATUS(status)) + ")\n";
  }
  return text;
}

}  // namespace quoin::deploy
