// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "deploy/orchestration/frozen_file.hpp"

#include <cerrno>
#include <fcntl.h>
#include <string_view>
#include <sys/mman.h>
#include <system_error>
#include <unistd.h>

namespace quoin::deploy {

FrozenFile::FrozenFile(const std::string& text) {
  const auto fail = [this](const char* what) {
    const std::error_code error(errno, std::generic_category());
    if (descriptor_ >= 0) ::close(descriptor_);
    throw std::system_error(error, what);
  };
  descriptor_ = ::memfd_create("deployment.yaml", MFD_CLOEXEC | MFD_ALLOW_SEALING);
  if (descriptor_ < 0) fail("memfd_create");
  for (std::string_view rest = text; !rest.empty();) {
    const ssize_t count = ::write(descriptor_, rest.data(), rest.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) fail("cannot keep a copy of the deployment file");
    rest.remove_prefix(static_cast<std::size_t>(count));
  }
  if (::fcntl(descriptor_, F_ADD_SEALS, F_SEAL_SEAL | F_SEAL_WRITE | F_SEAL_GROW | F_SEAL_SHRINK) !=
      0) {
    fail("cannot seal the copy of the deployment file");
  }
  path_ = "/proc/" + std::to_string(::getpid()) + "/fd/" + std::to_string(descriptor_);
}

FrozenFile::~FrozenFile() { ::close(descriptor_); }

}  // namespace quoin::deploy
