// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "sensor_bridge/rplidar/emulator/console.hpp"

#include <array>
#include <cerrno>
#include <csignal>
#include <poll.h>
#include <sys/signalfd.h>
#include <system_error>
#include <unistd.h>

#include "sensor_bridge/rplidar/emulator/fault.hpp"
#include "sensor_bridge/transport/file_descriptor.hpp"

namespace quoin::sensor_bridge::rplidar {
namespace {

constexpr std::size_t longest_line = 4096;

std::string help() {
  std::string text = "clear (ends all faults), status, quit, or a fault such as 'unplug 5s':";
  for (const std::string& name : fault_names()) text += " " + name;
  return text;
}

}  // namespace

std::string carry_out(Emulator& emulator, std::string_view line, bool& quit) {
  const std::size_t begin = line.find_first_not_of(" \t\r");
  if (begin == std::string_view::npos) return "";
  line = line.substr(begin, line.find_last_not_of(" \t\r") + 1 - begin);
  if (line == "quit") {
    quit = true;
  } else if (line == "clear") {
    emulator.clear_faults();
  } else if (line == "help") {
    return help();
  } else if (line == "status") {
    return status_text(emulator.status());
  } else {
    try {
      emulator.apply(parse_typed_fault(line));
    } catch (const FaultError& error) {
      return std::string(error.what()) + " ('help' lists all that can be typed)";
    }
  }
  return "";
}

void run_console(Emulator& emulator, const std::function<void(const std::string&)>& print) {
  sigset_t ends;
  ::sigemptyset(&ends);
  ::sigaddset(&ends, SIGINT);
  ::sigaddset(&ends, SIGTERM);
  const FileDescriptor signals(::signalfd(-1, &ends, SFD_CLOEXEC));
  if (!signals) throw std::system_error(errno, std::generic_category(), "signalfd");

  std::string typed;
  std::array<pollfd, 2> descriptors{pollfd{signals.get(), POLLIN, 0},
                                    pollfd{STDIN_FILENO, POLLIN, 0}};
  for (bool quit = false; !quit;) {
    if (::poll(descriptors.data(), descriptors.size(), -1) < 0 && errno != EINTR) return;
    if (descriptors[0].revents != 0) return;
    if (descriptors[1].revents == 0) continue;
    std::array<char, 512> piece;
    const ssize_t size = ::read(STDIN_FILENO, piece.data(), piece.size());
    if (size < 0 && (errno == EINTR || errno == EAGAIN)) continue;
    if (size <= 0) {
      descriptors[1].fd = -1;  // nothing more to come
      continue;
    }
    typed.append(piece.data(), static_cast<std::size_t>(size));
    for (std::size_t end = typed.find('\n'); end != std::string::npos && !quit;
         end = typed.find('\n')) {
      const std::string answer = carry_out(emulator, std::string_view(typed).substr(0, end), quit);
      if (!answer.empty()) print(answer);
      typed.erase(0, end + 1);
    }
    if (typed.size() > longest_line) typed.clear();
  }
}

}  // namespace quoin::sensor_bridge::rplidar
