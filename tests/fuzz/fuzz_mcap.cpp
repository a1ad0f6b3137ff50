// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
//
// Any bytes as an MCAP file: read to the end, over what is damaged, and its summary.
#include <cstddef>
#include <cstdint>
#include <string>

#include "sensor_bridge/message_files/mcap_reader.hpp"
#include "tests/fuzz/memory_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace quoin::sensor_bridge;
  const quoin::fuzz::MemoryFile file(data, size);
  try {
    mcap::Reader reader(file.path());
    mcap::RecordedMessage message;
    std::uint64_t messages = 0;
    for (bool more = true; more;) {
      try {
        while (reader.next(message)) {
          quoin::fuzz::require(message.channel != nullptr, "a message has a channel");
          ++messages;
        }
        more = false;
      } catch (const ScanFileError&) {
        more = reader.resume();
      }
    }
    std::uint64_t counted = 0;
    for (const auto& [channel, count] : reader.counts()) counted += count;
    quoin::fuzz::require(counted == messages, "every message is counted");
    (void)reader.summary();
  } catch (const ScanFileError&) {
  }
  return 0;
}
