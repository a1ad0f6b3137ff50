// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <fstream>
#include <sstream>
#include <string_view>

#include "deploy/diagnostics/host_checks.hpp"
#include "deploy/kinds/kinds.hpp"

namespace quoin::deploy {

namespace {

namespace fs = std::filesystem;

std::vector<fs::path> process_folders(const fs::path& processes) {
  std::vector<fs::path> folders;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(processes, ignored)) {
    const std::string name = entry.path().filename();
    if (name.find_first_not_of("0123456789") == std::string::npos) folders.push_back(entry.path());
  }
  return folders;
}

/// The arguments of a process, program first.
std::vector<std::string> arguments_of(const fs::path& process) {
  std::ifstream stream(process / "cmdline", std::ios::binary);
  std::vector<std::string> arguments;
  for (std::string argument; std::getline(stream, argument, '\0');) arguments.push_back(argument);
  return arguments;
}

/// What a process's status file says under `key`.
std::string status_of(const fs::path& process, std::string_view key) {
  std::ifstream stream(process / "status");
  for (std::string line; std::getline(stream, line);) {
    if (!line.starts_with(key) || line.substr(key.size(), 1) != ":") continue;
    const auto at = line.find_first_not_of(" \t", key.size() + 1);
    return at == std::string::npos ? "" : line.substr(at);
  }
  return "";
}

bool is_service(const std::vector<std::string>& arguments) {
  if (arguments.empty()) return false;
  const std::string program = fs::path(arguments.front()).filename();
  if (program == process_program()) return true;
  return std::any_of(kinds().kinds.begin(), kinds().kinds.end(), [&](const KindInfo* kind) {
    return !kind->program.empty() && kind->program == program;
  });
}

/// Whether systemd looks after it.
bool is_unit(const fs::path& process) {
  std::ifstream stream(process / "cgroup");
  for (std::string line; std::getline(stream, line);) {
    if (line.ends_with(".service")) return true;
  }
  return false;
}

/// The process that has the socket of this inode open; an empty path when that cannot be seen.
fs::path holder_of(const std::string& inode, const fs::path& processes) {
  const std::string wanted = "socket:[" + inode + "]";
  for (const fs::path& process : process_folders(processes)) {
    std::error_code ignored;
    for (fs::directory_iterator open(process / "fd", ignored), end; open != end;
         open.increment(ignored)) {
      if (fs::read_symlink(open->path(), ignored) == wanted) return process;
    }
  }
  return {};
}

}  // namespace

Check check_orphans(const fs::path& processes) {
  std::string found, kill;
  for (const fs::path& process : process_folders(processes)) {
    const std::vector<std::string> arguments = arguments_of(process);
    if (!is_service(arguments) || status_of(process, "PPid") != "1" || is_unit(process)) continue;
    const auto option = std::ranges::find_if(arguments, [](const std::string& argument) {
      return argument == "--service" || argument == "--process";
    });
    const std::string name = arguments.end() - option > 1 ? *(option + 1) : arguments.front();
    const std::string number = process.filename();
    found += (found.empty() ? "" : ", ") + name + " (process " + number + ")";
    kill += " " + number;
  }
  if (found.empty()) return {"processes", Verdict::good, "no service without a supervisor", ""};
  return {"processes", Verdict::doubtful,
          found +
              " run without quoin up or systemd: nobody starts them again, and they may double "
              "what a new deployment does",
          "if nobody needs them: kill" + kill};
}

Check check_supervisor(const Deployment& deployment, const fs::path& sockets,
                       const fs::path& processes) {
  // What Exclusive binds.
  const std::string name =
      "@quoin/" + std::to_string(deployment.domain) + "/" + deployment.name_space;
  std::ifstream stream(sockets);
  std::string inode;
  for (std::string line; std::getline(stream, line);) {
    std::istringstream columns(line);
    std::string skipped, number, path;
    for (int column = 0; column < 6; ++column) columns >> skipped;
    columns >> number >> path;
    if (path == name) inode = number;
  }
  if (inode.empty()) return {"supervisor", Verdict::good, "quoin up does not run here", ""};
  const fs::path holder = holder_of(inode, processes);
  if (holder.empty()) {
    return {"supervisor", Verdict::good, "quoin up runs here as another user", ""};
  }
  const std::string number = holder.filename();
  const std::string state = status_of(holder, "State").substr(0, 1);
  if (state == "T" || state == "t") {
    return {"supervisor", Verdict::bad,
            "quoin up (process " + number +
                ") is stopped: it watches over nothing, and no other can start this deployment",
            "kill -CONT " + number + " lets it go on; kill -KILL " + number + " ends it"};
  }
  return {"supervisor", Verdict::good, "quoin up runs here (process " + number + ")", ""};
}

}  // namespace quoin::deploy
