// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/files/atomic_file.hpp"

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <fcntl.h>
#include <string>
#include <sys/stat.h>
#include <unistd.h>

namespace quoin {

namespace {

/// Returns 0 or the error.
int write_all(int descriptor, std::string_view content, mode_t mode) {
  if (::fchmod(descriptor, mode) != 0) return errno;
  while (!content.empty()) {
    const ssize_t count = ::write(descriptor, content.data(), content.size());
    if (count < 0 && errno != EINTR) return errno;
    if (count > 0) content.remove_prefix(static_cast<std::size_t>(count));
  }
  return ::fsync(descriptor) == 0 ? 0 : errno;
}

}  // namespace

int write_atomically(const std::filesystem::path& file, std::string_view content, mode_t mode,
                     bool replace) {
  std::string unfinished = file.string() + ".XXXXXX";
  const int descriptor = ::mkostemp(unfinished.data(), O_CLOEXEC);
  if (descriptor < 0) return errno;
  int error = write_all(descriptor, content, mode);
  if (::close(descriptor) != 0 && error == 0) error = errno;
  if (error == 0 && ::renameat2(AT_FDCWD, unfinished.c_str(), AT_FDCWD, file.c_str(),
                                replace ? 0 : RENAME_NOREPLACE) != 0) {
    error = errno;
  }
  if (error != 0) ::unlink(unfinished.c_str());
  return error;
}

}  // namespace quoin
