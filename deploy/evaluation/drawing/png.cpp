// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "deploy/evaluation/drawing/png.hpp"

#include <array>
#include <cerrno>
#include <spawn.h>
#include <stdexcept>
#include <string_view>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

extern char** environ;  // NOLINT: POSIX has no header for it

namespace quoin::deploy {

namespace {

constexpr const char* converter = "rsvg-convert";

/// A file in memory, for a process to read or to write.
class MemoryFile {
 public:
  MemoryFile() : descriptor_(::memfd_create("picture", MFD_CLOEXEC)) {
    if (descriptor_ < 0) throw std::runtime_error("the picture cannot be drawn: out of files");
  }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;
  ~MemoryFile() { ::close(descriptor_); }

  [[nodiscard]] int descriptor() const { return descriptor_; }

  void write(std::string_view text) const {
    while (!text.empty()) {
      const ssize_t written = ::write(descriptor_, text.data(), text.size());
      if (written <= 0) throw std::runtime_error("the picture cannot be drawn: out of memory");
      text.remove_prefix(static_cast<std::size_t>(written));
    }
    ::lseek(descriptor_, 0, SEEK_SET);
  }

  [[nodiscard]] std::string content() const {
    std::string text;
    std::array<char, 65536> part{};
    for (off_t at = 0;; at = static_cast<off_t>(text.size())) {
      const ssize_t got = ::pread(descriptor_, part.data(), part.size(), at);
      if (got <= 0) return text;
      text.append(part.data(), static_cast<std::size_t>(got));
    }
  }

 private:
  int descriptor_;
};

/// Runs the converter until it ends, and returns its exit code. Throws when there is none.
int convert_picture(const std::string& scale, const MemoryFile& svg, const MemoryFile& png,
                    const MemoryFile& errors) {
  std::array<std::string, 4> words{converter, "--format=png", "--zoom=" + scale,
                                   "--background-color=white"};
  std::array<char*, 5> arguments{};
  for (std::size_t i = 0; i < words.size(); ++i) arguments[i] = words[i].data();
  posix_spawn_file_actions_t actions{};
  ::posix_spawn_file_actions_init(&actions);
  ::posix_spawn_file_actions_adddup2(&actions, svg.descriptor(), STDIN_FILENO);
  ::posix_spawn_file_actions_adddup2(&actions, png.descriptor(), STDOUT_FILENO);
  ::posix_spawn_file_actions_adddup2(&actions, errors.descriptor(), STDERR_FILENO);
  pid_t process = 0;
  const int failed =
      ::posix_spawnp(&process, converter, &actions, nullptr, arguments.data(), environ);
  ::posix_spawn_file_actions_destroy(&actions);
  if (failed != 0) {
    throw std::runtime_error(
        "PNG files are made by rsvg-convert, which is not there; install it (Debian: "
        "librsvg2-bin), or write a file that ends in .svg");
  }
  int status = 0;
  while (::waitpid(process, &status, 0) < 0 && errno == EINTR) {
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : 1;
}

}  // namespace

std::string png_of(const std::string& svg, double scale) {
  const MemoryFile input;
  const MemoryFile output;
  const MemoryFile errors;
  input.write(svg);
  if (convert_picture(std::to_string(scale), input, output, errors) != 0) {
    throw std::runtime_error("the picture cannot be drawn: " + errors.content());
  }
  return output.content();
}

}  // namespace quoin::deploy
