// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

namespace quoin::sensor_bridge::rplidar {

/// How measurements are laid out on the wire; the value is the type byte of the descriptor that
/// announces them.
enum class SampleFormat : std::uint8_t {
  standard = 0x81,
  express = 0x82,
  hq = 0x83,
  ultra = 0x84,
  dense = 0x85,
  ultra_dense = 0x86,
};

inline constexpr SampleFormat sample_formats[] = {
    SampleFormat::standard, SampleFormat::express, SampleFormat::hq,
    SampleFormat::ultra,    SampleFormat::dense,   SampleFormat::ultra_dense};

/// Bytes and measurements of one frame: a node, or a capsule of many points.
struct FrameLayout {
  std::size_t bytes;
  std::size_t samples;
};

[[nodiscard]] constexpr FrameLayout layout_of(SampleFormat format) {
  switch (format) {
    case SampleFormat::standard:
      return {5, 1};
    case SampleFormat::express:
      return {84, 32};
    case SampleFormat::hq:
      return {781, 96};
    case SampleFormat::ultra:
      return {132, 96};
    case SampleFormat::dense:
      return {84, 40};
    case SampleFormat::ultra_dense:
      return {170, 64};
  }
  return {1, 0};
}

inline constexpr std::size_t largest_frame_bytes = layout_of(SampleFormat::hq).bytes;

/// The format of this type byte, or nothing when it is none.
[[nodiscard]] std::optional<SampleFormat> sample_format(std::uint8_t type);

/// Such as "dense (0x85)".
[[nodiscard]] std::string format_name(SampleFormat format);

}  // namespace quoin::sensor_bridge::rplidar
