// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "sensor_bridge/rplidar/protocol/sample_format.hpp"

namespace quoin::sensor_bridge::rplidar {

std::optional<SampleFormat> sample_format(std::uint8_t type) {
  for (const SampleFormat format : sample_formats) {
    if (static_cast<std::uint8_t>(format) == type) return format;
  }
  return std::nullopt;
}

std::string format_name(SampleFormat format) {
  switch (format) {
    case SampleFormat::standard:
      return "standard (0x81)";
    case SampleFormat::express:
      return "express (0x82)";
    case SampleFormat::hq:
      return "hq (0x83)";
    case SampleFormat::ultra:
      return "ultra (0x84)";
    case SampleFormat::dense:
      return "dense (0x85)";
    case SampleFormat::ultra_dense:
      return "ultra dense (0x86)";
  }
  return "no format";
}

}  // namespace quoin::sensor_bridge::rplidar
