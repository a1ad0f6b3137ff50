// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>

namespace quoin::sensor_bridge::rplidar {

/// Exclusive or of all bytes.
[[nodiscard]] std::uint8_t xor_checksum(std::span<const std::uint8_t> bytes);

/// CRC-32 of zlib over the bytes and the zeros that HQ capsules reckon behind them: up to the next
/// multiple of four, and four of them where there is none to fill up.
[[nodiscard]] std::uint32_t padded_crc32(std::span<const std::uint8_t> bytes);

}  // namespace quoin::sensor_bridge::rplidar
