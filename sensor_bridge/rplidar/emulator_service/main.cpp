// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "sensor_bridge/rplidar/emulator_service/emulator_service.hpp"
#include "sensor_bridge/rplidar/emulator_service/kind.hpp"

int main(int argc, char** argv) {
  return quoin::runtime::run_activity(argc, argv,
                                      quoin::sensor_bridge::rplidar::rplidar_emulator_kind(),
                                      quoin::sensor_bridge::rplidar::open_emulator);
}
