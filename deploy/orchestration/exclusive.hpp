// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "services/deployment/deployment.hpp"

namespace quoin::deploy {

/// The right to run a deployment's namespace and domain on this host. Two that run under the same
/// names would read each other's messages. Held until the object or the process ends, and by what
/// this process starts.
class Exclusive {
 public:
  /// Throws std::runtime_error when somebody else has it. Processes of one that was killed end by
  /// themselves: they are waited for.
  explicit Exclusive(const Deployment& deployment);
  ~Exclusive();
  Exclusive(const Exclusive&) = delete;
  Exclusive& operator=(const Exclusive&) = delete;

 private:
  int socket_ = -1;
  int processes_ = -1;  // which they keep open
};

}  // namespace quoin::deploy
