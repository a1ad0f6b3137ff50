// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "sensor_bridge/rplidar/driver/scan_stream.hpp"

#include <algorithm>
#include <chrono>

namespace quoin::sensor_bridge::rplidar {
namespace {

/// As many bytes tell formats apart: three frames of the longest one.
constexpr std::size_t bytes_of_the_format = 3 * largest_frame_bytes;
/// The last frame is cut off, and some may be damaged.
constexpr double share_of_right_format = 0.6;
/// [s] in which a sample period is measured before there are revolutions; it is refined later.
constexpr double metering_time = 1.0;
constexpr std::uint64_t most_impossible = 3;  // in a row

/// [s] that the line takes for a frame.
double line_time(SampleFormat format, double line_rate) {
  constexpr double bits = 10;  // of a byte, with start and stop
  return line_rate > 0.0 ? static_cast<double>(layout_of(format).bytes) * bits / line_rate : 0.0;
}

/// Share of the bytes that are in frames of this format.
double share_in_frames(SampleFormat format, std::span<const std::uint8_t> bytes) {
  SampleDecoder decoder(format);
  SampleBlock block;
  const auto total = static_cast<double>(bytes.size());
  while (decoder.next(bytes, block)) {
  }
  return static_cast<double>(decoder.counts().frames * layout_of(format).bytes) / total;
}

}  // namespace

std::optional<SampleFormat> format_of(std::span<const std::uint8_t> bytes, SampleFormat likely) {
  if (bytes.empty()) return std::nullopt;
  if (share_in_frames(likely, bytes) > share_of_right_format) return likely;
  for (const SampleFormat format : sample_formats) {
    if (share_in_frames(format, bytes) > share_of_right_format) return format;
  }
  return std::nullopt;
}

ScanStream::ScanStream(const ScanMode& mode, double line_rate, SampleFormat asked)
    : mode_(mode), line_rate_(line_rate), asked_(asked), decoder_(mode.format) {
  if (mode_.sample_period > 0.0) assemble();
}

void ScanStream::assemble() {
  assembler_.emplace(mode_.sample_period, line_time(mode_.format, line_rate_));
}

void ScanStream::take(std::span<const std::uint8_t> bytes, TimePoint now,
                      const OnRevolution& on_revolution) {
  bytes_ += bytes.size();
  if (first_bytes_.size() < bytes_of_the_format) look_at_format(bytes);
  while (!other_format_ && decoder_.next(bytes, block_)) {
    if (!assembler_) {
      measure_period(block_, now);
    } else if (assembler_->add(block_, now, revolution_)) {
      last_good_ = assembler_->impossible_revolutions();
      on_revolution(revolution_);
    }
  }
}

std::optional<double> ScanStream::impossible_rotation() const {
  if (!assembler_ || assembler_->impossible_revolutions() - last_good_ < most_impossible) {
    return std::nullopt;
  }
  return assembler_->impossible_rotation();
}

void ScanStream::look_at_format(std::span<const std::uint8_t> bytes) {
  const std::size_t count = std::min(bytes.size(), bytes_of_the_format - first_bytes_.size());
  first_bytes_.insert(first_bytes_.end(), bytes.begin(),
                      bytes.begin() + static_cast<std::ptrdiff_t>(count));
  if (first_bytes_.size() < bytes_of_the_format) return;
  if (share_in_frames(mode_.format, first_bytes_) > share_of_right_format) return;
  const std::optional<SampleFormat> format = format_of(first_bytes_, asked_);
  if (format && *format != mode_.format) other_format_ = format;
}

void ScanStream::measure_period(const SampleBlock& block, TimePoint now) {
  if (!metering_since_) {
    metering_since_ = now;
    return;
  }
  metered_samples_ += block.size + block.lost;
  const double time = std::chrono::duration<double>(now - *metering_since_).count();
  if (time < metering_time) return;
  mode_.sample_period = time / static_cast<double>(metered_samples_);
  assemble();
}

}  // namespace quoin::sensor_bridge::rplidar
