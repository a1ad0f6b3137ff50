// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "deploy/orchestration/file_watch.hpp"

#include <sys/stat.h>

namespace quoin::deploy {

namespace {
constexpr std::chrono::milliseconds period{100};
constexpr std::chrono::milliseconds rest{200};
}  // namespace

std::optional<FileWatch::Identity> FileWatch::look() const {
  struct stat status {};
  if (::stat(file_.c_str(), &status) != 0) return std::nullopt;
  return Identity{status.st_dev, status.st_ino, status.st_size,
                  status.st_mtim.tv_sec * 1'000'000'000LL + status.st_mtim.tv_nsec};
}

bool FileWatch::changed(Clock::time_point now) {
  if (now < next_look_) return false;
  next_look_ = now + period;
  const std::optional<Identity> identity = look();
  if (!identity || identity == known_) {
    seen_.reset();
    return false;
  }
  if (identity != seen_) {
    seen_ = identity;
    seen_since_ = now;
    return false;
  }
  if (now - seen_since_ < rest) return false;
  known_ = identity;
  seen_.reset();
  return true;
}

}  // namespace quoin::deploy
