// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "deploy/diagnostics/shared_memory.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <fcntl.h>
#include <fstream>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include "deploy/observation/table.hpp"

namespace quoin::deploy {

namespace {

namespace fs = std::filesystem;

/// What belongs together has one name but for these: segment, lock and semaphore of a port.
std::string group_of(std::string name) {
  constexpr std::string_view semaphore = "sem.";
  if (name.starts_with(semaphore)) name.erase(0, semaphore.size());
  for (const std::string_view suffix : {"_el", "_sl", "_mutex"}) {
    if (name.ends_with(suffix)) name.erase(name.size() - suffix.size());
  }
  return name;
}

// What the names of Fast DDS's files begin with.
constexpr std::array<std::string_view, 3> beginnings = {
    "fastrtps_",          // segments and ports of version 2
    "fastdds_",           // of version 3
    "fast_datasharing_",  // histories of either
};

bool of_fast_dds(const std::string& group) {
  return std::ranges::any_of(beginnings,
                             [&](std::string_view begin) { return group.starts_with(begin); });
}

bool is_number(const std::string& text) {
  return !text.empty() && text.find_first_not_of("0123456789") == std::string::npos;
}

/// Names of the files of `folder` that some process has open or mapped. What cannot be read belongs
/// to another user, or to a process that has just ended.
std::set<std::string> names_in_use(const fs::path& folder, const fs::path& processes) {
  std::set<std::string> names;
  const std::string prefix = folder.string() + "/";
  const auto add = [&](std::string_view path) {
    if (!path.starts_with(prefix)) return;
    names.emplace(path.substr(prefix.size()));
  };
  std::error_code ignored;
  for (const auto& process : fs::directory_iterator(processes, ignored)) {
    if (!is_number(process.path().filename())) continue;
    std::ifstream maps(process.path() / "maps");
    for (std::string line; std::getline(maps, line);) {
      if (const auto at = line.find(prefix); at != std::string::npos) {
        add(std::string_view(line).substr(at));
      }
    }
    for (fs::directory_iterator open(process.path() / "fd", ignored), end; open != end;
         open.increment(ignored)) {
      add(fs::read_symlink(open->path(), ignored).string());
      if (ignored) ignored.clear();
    }
  }
  return names;
}

/// Whether somebody, perhaps in a container where this process cannot look, holds a lock on it.
bool is_locked(const fs::path& path) {
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW);
  if (descriptor < 0) return false;
  const bool locked = ::flock(descriptor, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK;
  ::close(descriptor);
  return locked;
}

}  // namespace

std::vector<StaleFile> stale_files(const fs::path& folder, const fs::path& processes) {
  std::map<std::string, std::vector<StaleFile>> groups;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder, ignored)) {
    const std::string group = group_of(entry.path().filename());
    struct stat status {};
    if (!of_fast_dds(group) || ::lstat(entry.path().c_str(), &status) != 0) continue;
    if (!S_ISREG(status.st_mode) || (status.st_uid != ::geteuid() && ::geteuid() != 0)) continue;
    groups[group].push_back(
        {entry.path(), static_cast<std::uint64_t>(status.st_size), status.st_uid == ::geteuid()});
  }
  if (groups.empty()) return {};
  for (const std::string& name : names_in_use(folder, processes)) groups.erase(group_of(name));
  std::vector<StaleFile> stale;
  for (const auto& [group, files] : groups) {
    const bool locked = std::any_of(files.begin(), files.end(),
                                    [](const StaleFile& file) { return is_locked(file.path); });
    if (!locked) stale.insert(stale.end(), files.begin(), files.end());
  }
  return stale;
}

std::size_t remove(const std::vector<StaleFile>& files) {
  std::size_t removed = 0;
  for (const StaleFile& file : files) {
    if (file.ours && ::unlink(file.path.c_str()) == 0) ++removed;
  }
  return removed;
}

Check check_shared_memory(const std::vector<StaleFile>& files) {
  if (files.empty()) return {"shared memory", Verdict::good, "no file of a dead program", ""};
  double bytes = 0.0;
  std::size_t ours = 0;
  for (const StaleFile& file : files) {
    bytes += static_cast<double>(file.bytes);
    if (file.ours) ++ours;
  }
  std::string advice = "quoin doctor --fix removes them";
  if (ours == 0) {
    advice = "their owner's quoin doctor --fix removes them";
  } else if (ours < files.size()) {
    advice = "quoin doctor --fix removes the " + std::to_string(ours) + " of this user";
  }
  return {"shared memory", Verdict::doubtful,
          std::to_string(files.size()) + " files of killed Fast DDS programs, such as " +
              files.front().path.string() + ": they take up to " + fixed(bytes / (1 << 20), 1) +
              " MiB of memory, and delay the match of new programs that use shared memory",
          advice};
}

}  // namespace quoin::deploy
