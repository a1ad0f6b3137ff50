// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "deploy/orchestration/exclusive.hpp"

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <sys/socket.h>
#include <sys/un.h>
#include <system_error>
#include <unistd.h>

namespace quoin::deploy {

Exclusive::Exclusive(const Deployment& deployment) {
  // An abstract socket leaves no file behind, goes with the process, and reaches as far as a host's
  // interfaces do: one network namespace.
  const std::string name =
      "quoin/" + std::to_string(deployment.domain) + "/" + deployment.name_space;
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  const std::size_t length = std::min(name.size(), sizeof address.sun_path - 1);
  std::copy_n(name.begin(), length, address.sun_path + 1);
  socket_ = ::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
  if (socket_ < 0) throw std::system_error(errno, std::generic_category(), "socket");
  const auto size = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + 1 + length);
  if (::bind(socket_, reinterpret_cast<const sockaddr*>(&address), size) == 0) return;
  const int error = errno;
  ::close(socket_);
  if (error != EADDRINUSE) throw std::system_error(error, std::generic_category(), "bind");
  throw std::runtime_error("a deployment with namespace '" + deployment.name_space +
                           "' is already up in domain " + std::to_string(deployment.domain) +
                           "; stop it, or give this one another namespace or domain");
}

Exclusive::~Exclusive() { ::close(socket_); }

}  // namespace quoin::deploy
