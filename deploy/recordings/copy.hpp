// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <string>
#include <vector>

namespace quoin::deploy {

/// Which messages of MCAP files go into a new one.
struct CopyRequest {
  std::vector<std::filesystem::path> inputs;
  std::filesystem::path output;
  double from = 0.0;  ///< [s] after the first message of all
  double to = std::numeric_limits<double>::infinity();
  bool recover = false;  ///< what is damaged is passed over; else it is an error
};

struct CopyOutcome {
  std::uint64_t messages = 0;
  std::vector<std::string> damages;  ///< that were passed over, each with its place
  bool interrupted = false;
};

/// Copies messages in the order of their log times, with their schemas, channels, metadata and
/// attachments. `go_on` is asked now and then with the number of messages so far; when it says no,
/// nothing is left of the output. Throws ScanFileError or mcap::WriteError; then, too.
CopyOutcome copy_messages(const CopyRequest& request,
                          const std::function<bool(std::uint64_t messages)>& go_on);

}  // namespace quoin::deploy
