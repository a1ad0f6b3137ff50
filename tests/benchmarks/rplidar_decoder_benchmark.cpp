// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
//
// What decoding a stream of each RPLIDAR format costs, against a plain pass that xors the same
// bytes frame by frame and one that xors them in one go, in the same run; prints one ratio a line.
//   taskset -c 1 rplidar_decoder_benchmark
#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <random>
#include <span>
#include <vector>

#include <benchmark/benchmark.h>

#include "sensor_bridge/rplidar/protocol/sample_decoder.hpp"
#include "sensor_bridge/rplidar/protocol/sample_encoder.hpp"

namespace {

using namespace quoin::sensor_bridge::rplidar;

/// Frames of a sensor that turns ten times a second in a room of uneven walls.
std::vector<std::uint8_t> stream_of(SampleFormat format, std::size_t size) {
  SampleEncoder encoder(format);
  const FrameLayout layout = layout_of(format);
  std::mt19937 random(20260422);
  std::uniform_int_distribution<std::uint32_t> distance(2000, 32000);
  std::vector<Sample> samples(layout.samples);
  std::vector<std::uint8_t> bytes;
  std::uint32_t angle = 0;
  while (bytes.size() + layout.bytes <= size) {
    const std::uint32_t wall = distance(random);
    for (Sample& sample : samples) {
      sample = {angle, wall + distance(random) % 64, 188};
      angle = (angle + full_circle_q16 / 926) % full_circle_q16;
    }
    encoder.encode(samples, 0, bytes);
  }
  return bytes;
}

void plain_pass(std::span<const std::uint8_t> bytes, std::size_t piece) {
  while (!bytes.empty()) {
    const std::size_t size = std::min(piece, bytes.size());
    std::uint8_t sum = 0;
    for (const std::uint8_t byte : bytes.first(size)) sum = static_cast<std::uint8_t>(sum ^ byte);
    benchmark::DoNotOptimize(sum);
    bytes = bytes.subspan(size);
  }
}

void decode(std::span<const std::uint8_t> bytes, SampleFormat format) {
  SampleDecoder decoder(format);
  SampleBlock block;
  while (decoder.next(bytes, block)) benchmark::DoNotOptimize(&block);
}

/// [s] of one call, as the fastest of many tells.
template <class Function>
void time_once(Function function, double& fastest) {
  const auto begin = std::chrono::steady_clock::now();
  function();
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - begin;
  fastest = std::min(fastest, elapsed.count());
}

}  // namespace

int main() {
  constexpr std::size_t stream_bytes = 16384;
  constexpr int rounds = 2000;
  std::printf("%-20s %12s %12s %12s %12s\n", "format", "ns a frame", "MB/s", "x by frame",
              "x in one go");
  for (const SampleFormat format : sample_formats) {
    const std::vector<std::uint8_t> bytes = stream_of(format, stream_bytes);
    const std::size_t frame_bytes = layout_of(format).bytes;
    double decoding = 1.0;
    double by_frame = 1.0;
    double in_one_go = 1.0;
    for (int round = 0; round < rounds; ++round) {
      time_once([&] { plain_pass(bytes, frame_bytes); }, by_frame);
      time_once([&] { decode(bytes, format); }, decoding);
      time_once([&] { plain_pass(bytes, bytes.size()); }, in_one_go);
    }
    const double frames = static_cast<double>(bytes.size() / frame_bytes);
    std::printf("%-20s %12.1f %12.0f %12.2f %12.2f\n", format_name(format).c_str(),
                1e9 * decoding / frames, 1e-6 * static_cast<double>(bytes.size()) / decoding,
                decoding / by_frame, decoding / in_one_go);
  }
}
