// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "sensor_bridge/message_files/message_file.hpp"

namespace quoin::deploy {

/// What is in a recording of messages of whatever kind.
struct Contents {
  std::string format;
  std::uint64_t bytes = 0;
  std::int64_t start = 0;  ///< [ns since the Unix epoch] of the first message
  std::int64_t end = 0;
  std::uint64_t messages = 0;
  std::map<std::string, sensor_bridge::FileTopic> topics;
  std::map<std::string, std::map<std::string, std::string>> metadata;  ///< of MCAP
  std::vector<std::string> attachments;
  std::string damage;  ///< where reading ended, and why; "" when the file is whole
};

/// Reads the summary of an MCAP file, or with `thorough` all of it, comparing checksums, index and
/// statistics; of other files always all. Throws ScanFileError when it cannot be opened.
[[nodiscard]] Contents read_contents(const std::filesystem::path& file, bool thorough,
                                     const std::function<void(std::uint64_t messages)>& progress);

[[nodiscard]] std::vector<std::string> contents_lines(const Contents& contents);
[[nodiscard]] nlohmann::ordered_json contents_json(const Contents& contents);

}  // namespace quoin::deploy
