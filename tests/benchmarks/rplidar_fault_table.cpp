// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
//
// Prints what becomes of the scans of each emulated RPLIDAR in each of its formats under each
// fault: revolutions, points off the walls, samples lost and counted. Simulated time: the same on
// every machine.

#include <cstdio>
#include <cstring>
#include <string>
#include <vector>

#include "tests/sensor_bridge/rplidar/emulator/measured_room.hpp"

namespace {

using namespace quoin::sensor_bridge::rplidar;

struct Trial {
  std::string name;
  std::string faults;
  double clock_error = 0.0;
  std::int64_t baud_rate = 0;
};

const std::vector<Trial> trials{
    {"none", ""},
    {"2 % of frames lost", "lost_frames=0.02"},
    {"2 % repeated", "repeated_frames=0.02"},
    {"2 % swapped", "swapped_frames=0.02"},
    {"2 % damaged", "wrong_checksums=0.02"},
    {"1 byte in 1000 lost", "dropped_bytes=0.001"},
    {"1 bit in 10000 flipped", "flipped_bits=0.0001"},
    {"1 bit in 1000 flipped", "flipped_bits=0.001"},
    {"clock 2 % slow, 2 % lost", "lost_frames=0.02", 0.02},
    {"clock 2 % fast, 2 % lost", "lost_frames=0.02", -0.02},
    {"two devices on the line", "second_device", 0.0, 4000000},
    {"turns at 25 Hz", "speed=25"},
    {"turns at 0.5 Hz", "speed=0.5"},
    {"announces standard nodes", "wrong_format"},
};

void print_row(const EmulatorSettings& settings, std::size_t mode, const Trial& trial) {
  EmulatorSettings device = settings;
  device.faults = trial.faults;
  device.clock_error = trial.clock_error;
  if (trial.baud_rate != 0) device.baud_rate = trial.baud_rate;
  const DeviceIdentity identity = identity_of(device);
  const SampleFormat format = identity.modes.at(mode).format;
  if (format == SampleFormat::standard && trial.faults == "wrong_format") return;
  const MeasuredRoom room = measure_room(device, mode, {.seconds = 24.0, .lateness = 0.002});
  std::printf("| %s | %s | %s | %zu | %zu | %.0f | %llu | %llu | %.2f |\n", settings.model.c_str(),
              format_name(format).c_str(), trial.name.c_str(), room.revolutions, room.wrong_points,
              1e3 * room.worst_point, static_cast<unsigned long long>(room.affected_samples),
              static_cast<unsigned long long>(room.lost_samples), 1e3 * room.worst_stamp);
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  const bool all = argc < 2;
  std::puts(
      "| device | format | fault | revolutions in 24 s | points over 30 mm off | worst [mm] | "
      "samples affected | counted as lost | worst stamp [ms] |\n"
      "|---|---|---|---|---|---|---|---|---|");
  for (const char* model : {"S1", "A1", "A2", "A3", "C1", "S2", "S3"}) {
    if (!all && std::strcmp(model, argv[1]) != 0) continue;
    EmulatorSettings settings;
    settings.model = model;
    settings.all_formats = settings.model == "S1";
    if (settings.all_formats) settings.baud_rate = 512000;
    const DeviceIdentity identity = identity_of(settings);
    std::vector<SampleFormat> done;
    for (std::size_t mode = 0; mode < identity.modes.size(); ++mode) {
      const SampleFormat format = identity.modes[mode].format;
      if (std::ranges::find(done, format) != done.end()) continue;
      done.push_back(format);
      for (const Trial& trial : trials) print_row(settings, mode, trial);
    }
  }
  return 0;
}
