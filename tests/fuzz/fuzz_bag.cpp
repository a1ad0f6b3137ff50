// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
//
// Any bytes as a bag of ROS 1 or ROS 2, whichever they begin like.
#include <cstddef>
#include <cstdint>

#include "sensor_bridge/message_files/message_file.hpp"
#include "tests/fuzz/memory_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace quoin::sensor_bridge;
  const quoin::fuzz::MemoryFile file(data, size);
  try {
    if (!message_file_kind(file.path())) return 0;
    const auto opened = open_message_file(file.path());
    FileMessage message;
    while (opened->next(message)) {
      quoin::fuzz::require(message.topic != nullptr, "a message has a topic");
    }
    (void)opened->topics();
  } catch (const ScanFileError&) {
  }
  return 0;
}
