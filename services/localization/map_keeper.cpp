// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/localization/map_keeper.hpp"

#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

namespace quoin {

MapKeeper::~MapKeeper() {
  wait();
  if (lock_ >= 0) ::close(lock_);
}

bool MapKeeper::is_written() const {
  return writing_.valid() &&
         writing_.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
}

bool MapKeeper::due() const {
  if (writing_.valid() && !is_written()) return false;
  return std::chrono::steady_clock::now() >= begun_ + period;
}

bool MapKeeper::lock() {
  if (lock_ >= 0) return true;
  const std::string name = file_.string() + ".lock";
  const int descriptor = ::open(name.c_str(), O_CREAT | O_RDWR | O_CLOEXEC | O_NOFOLLOW, 0644);
  if (descriptor < 0) {
    problem_ = "not saved: " + name + ": " + std::strerror(errno);
    return false;
  }
  if (::flock(descriptor, LOCK_EX | LOCK_NB) != 0) {
    ::close(descriptor);
    problem_ = "not saved: another process keeps its map in this file; name another one";
    return false;
  }
  lock_ = descriptor;
  return true;
}

void MapKeeper::save(maps::SavedMap map) {
  wait();
  begun_ = std::chrono::steady_clock::now();
  if (!lock()) return;
  writing_ = std::async(std::launch::async, [map = std::move(map), file = file_]() -> std::string {
    try {
      maps::write_whole(file, maps::map_text(map));
      return "";
    } catch (const std::exception& error) {
      return error.what();
    }
  });
}

void MapKeeper::wait() {
  if (!writing_.valid()) return;
  problem_ = writing_.get();
  saved_ = saved_ || problem_.empty();
}

std::string MapKeeper::status() {
  if (is_written()) wait();
  const std::string name = file_.filename().string() + ": ";
  if (!problem_.empty()) return name + problem_;
  return name + (saved_ ? "saved" : "not saved yet");
}

}  // namespace quoin
