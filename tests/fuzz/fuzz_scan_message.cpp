// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
//
// Any bytes as a scan of ROS 1, of ROS 2 or of ours: the first byte chooses.
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "sensor_bridge/recordings/laser_scan_message.hpp"
#include "tests/fuzz/require.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace quoin::sensor_bridge;
  if (size == 0) return 0;
  static RecordedScan scan;
  const auto kind = static_cast<ScanMessage>(data[0] % 3);
  const std::string_view bytes(reinterpret_cast<const char*>(data) + 1, size - 1);
  const std::string wrong = read_scan_message(kind, bytes, scan);
  quoin::fuzz::require(scan.bearings.size() == scan.ranges.size(), "a bearing for each range");
  quoin::fuzz::require(wrong.empty() || scan.ranges.empty(), "nothing of a scan that is wrong");
  return 0;
}
