// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "deploy/orchestration/exclusive.hpp"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <sys/socket.h>
#include <sys/un.h>
#include <system_error>
#include <thread>
#include <unistd.h>

#include "deploy/orchestration/process.hpp"

namespace quoin::deploy {

namespace {

// More than the processes of a supervisor that was killed take to end.
constexpr std::chrono::seconds longest_end{8};

/// An abstract socket leaves no file behind, goes with the last process that has it open, and
/// reaches as far as a host's interfaces do: one network namespace. -1 when somebody has it.
int bind_name(const std::string& name) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  const std::size_t length = std::min(name.size(), sizeof address.sun_path - 1);
  std::copy_n(name.begin(), length, address.sun_path + 1);
  const int descriptor = ::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
  if (descriptor < 0) throw std::system_error(errno, std::generic_category(), "socket");
  const auto size = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + 1 + length);
  if (::bind(descriptor, reinterpret_cast<const sockaddr*>(&address), size) == 0) return descriptor;
  const int error = errno;
  ::close(descriptor);
  if (error != EADDRINUSE) throw std::system_error(error, std::generic_category(), "bind");
  return -1;
}

}  // namespace

Exclusive::Exclusive(const Deployment& deployment) {
  const std::string place = std::to_string(deployment.domain) + "/" + deployment.name_space;
  socket_ = bind_name("quoin/" + place);
  if (socket_ < 0) {
    throw std::runtime_error("a deployment with namespace '" + deployment.name_space +
                             "' is already up in domain " + std::to_string(deployment.domain) +
                             "; stop it, or give this one another namespace or domain");
  }
  const auto deadline = std::chrono::steady_clock::now() + longest_end;
  while ((processes_ = bind_name("quoin_processes/" + place)) < 0) {
    if (std::chrono::steady_clock::now() >= deadline) {
      ::close(socket_);
      throw std::runtime_error("services of an earlier quoin up of namespace '" +
                               deployment.name_space + "' do not end; quoin doctor names them");
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  Process::keep_open(processes_);
}

Exclusive::~Exclusive() {
  Process::keep_open(-1);
  ::close(processes_);
  ::close(socket_);
}

}  // namespace quoin::deploy
