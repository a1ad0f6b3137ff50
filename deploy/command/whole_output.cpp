// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include <cerrno>
#include <cstring>
#include <iostream>
#include <string>

#include "deploy/command/commands.hpp"
#include "services/deployment/deployment.hpp"

namespace quoin::deploy {

int whole_output(int code) {
  errno = 0;
  std::cout.flush();
  if (std::cout || code != exit_ok) return code;
  std::cerr << "quoin: the output cannot be written"
            << (errno == 0 ? "" : std::string(": ") + std::strerror(errno)) << '\n';
  return exit_failure;
}

}  // namespace quoin::deploy
