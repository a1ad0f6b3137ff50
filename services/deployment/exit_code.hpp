// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace quoin {

/// Exit codes of all programs: what the supervisor concludes from them, the services must mean.
enum ExitCode : int {
  exit_ok = 0,
  exit_failure = 1,
  exit_configuration = 2,  ///< wrong usage or configuration: starting again does not help
  exit_input = 3,          ///< the input of a source is unusable
};

}  // namespace quoin
