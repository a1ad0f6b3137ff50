// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "sensor_bridge/rplidar/protocol/configuration.hpp"
#include "sensor_bridge/rplidar/protocol/revolution.hpp"
#include "sensor_bridge/rplidar/protocol/sample_decoder.hpp"

namespace quoin::sensor_bridge::rplidar {

/// The format whose frames make up these bytes; nothing when it is none of them. Express and dense
/// capsules look the same from outside: of these it is the likely one if that is one of them.
[[nodiscard]] std::optional<SampleFormat> format_of(std::span<const std::uint8_t> bytes,
                                                    SampleFormat likely);

/// Turns the bytes of a scan into revolutions. Looks at the first ones whether they are of the
/// format that was announced, and measures the sample period of a device that does not say it.
class ScanStream {
 public:
  /// The line between the device and what is read from carries `line_rate` [bit/s], also where it
  /// is inside of a network kit; 0 when unknown. `asked` is the format that the device was asked
  /// for.
  ScanStream(const ScanMode& mode, double line_rate, SampleFormat asked);

  using OnRevolution = std::function<void(const Revolution&)>;
  void take(std::span<const std::uint8_t> bytes, TimePoint now, const OnRevolution& on_revolution);

  /// The format that the first bytes have, when it is not that of the mode.
  [[nodiscard]] std::optional<SampleFormat> other_format() const { return other_format_; }

  /// With the period that is declared or, without a declaration, was measured.
  [[nodiscard]] const ScanMode& mode() const { return mode_; }
  [[nodiscard]] std::uint64_t bytes() const { return bytes_; }
  [[nodiscard]] const DecoderCounts& counts() const { return decoder_.counts(); }
  [[nodiscard]] std::uint64_t lost_samples() const {
    return assembler_ ? assembler_->lost_samples() : 0;
  }
  /// [s] once it is known better than from the declaration.
  [[nodiscard]] std::optional<double> measured_period() const {
    return assembler_ ? assembler_->clock().measured_period() : std::nullopt;
  }
  /// [rev/s] when the last revolutions, three at least, were of a speed that cannot be.
  [[nodiscard]] std::optional<double> impossible_rotation() const;

 private:
  void look_at_format(std::span<const std::uint8_t> bytes);
  void assemble();
  void measure_period(const SampleBlock& block, TimePoint now);

  ScanMode mode_;
  double line_rate_;
  SampleFormat asked_;
  SampleDecoder decoder_;
  std::optional<RevolutionAssembler> assembler_;  // as soon as the period is known
  std::uint64_t bytes_ = 0;
  std::vector<std::uint8_t> first_bytes_;
  std::optional<SampleFormat> other_format_;
  std::uint64_t last_good_ = 0;  // impossible revolutions up to the last good one
  std::optional<TimePoint> metering_since_;
  std::uint64_t metered_samples_ = 0;
  SampleBlock block_;
  Revolution revolution_;
};

}  // namespace quoin::sensor_bridge::rplidar
