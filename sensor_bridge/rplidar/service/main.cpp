// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "sensor_bridge/rplidar/service/kind.hpp"
#include "sensor_bridge/rplidar/service/rplidar_source.hpp"

int main(int argc, char** argv) {
  return quoin::runtime::run_source(argc, argv, quoin::sensor_bridge::rplidar::rplidar_kind(),
                                    quoin::sensor_bridge::rplidar::open_rplidar);
}
