// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/files/regular_file.hpp"

#include <algorithm>
#include <cerrno>
#include <fcntl.h>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>

namespace quoin {

namespace {

std::string reason(int error) { return std::generic_category().message(error); }

}  // namespace

RegularFile open_regular(const std::filesystem::path& file) {
  RegularFile result;
  // Some files of /proc are regular and have a reader wait all the same.
  const int descriptor = ::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY);
  struct stat status {};
  if (descriptor < 0 || ::fstat(descriptor, &status) != 0) {
    result.problem = reason(errno);
  } else if (S_ISDIR(status.st_mode)) {
    result.problem = "it is a folder";
  } else if (!S_ISREG(status.st_mode)) {
    result.problem = "it is not a regular file";
  }
  if (result.problem.empty()) {
    result.descriptor = descriptor;
    result.size = static_cast<std::uint64_t>(status.st_size);
  } else if (descriptor >= 0) {
    ::close(descriptor);
  }
  return result;
}

std::string read_regular(const std::filesystem::path& file, std::size_t longest,
                         std::string& text) {
  const RegularFile opened = open_regular(file);
  if (opened.descriptor < 0) return opened.problem;
  // Files of /proc have the size 0; one byte more than expected shows whether there is more.
  text.resize(std::min<std::uint64_t>(opened.size, longest) + 1);
  std::size_t size = 0;
  ssize_t count = 0;
  while (true) {
    if (size == text.size()) {
      if (size > longest) break;
      text.resize(std::min(2 * size, longest + 1));
    }
    count = ::read(opened.descriptor, text.data() + size, text.size() - size);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) break;
    size += static_cast<std::size_t>(count);
  }
  const std::string problem = count < 0 ? reason(errno) : "";
  ::close(opened.descriptor);
  text.resize(size);
  if (size > longest) return "it is larger than " + std::to_string(longest) + " bytes";
  return problem;
}

}  // namespace quoin
