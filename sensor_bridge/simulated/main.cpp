// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "sensor_bridge/simulated/kind.hpp"
#include "sensor_bridge/simulated/simulated_source.hpp"

int main(int argc, char** argv) {
  return quoin::runtime::run_source(argc, argv, quoin::sensor_bridge::simulated_kind(),
                                    quoin::sensor_bridge::open_simulated);
}
