// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "sensor_bridge/replay/kind.hpp"
#include "sensor_bridge/replay/replay_source.hpp"

int main(int argc, char** argv) {
  return quoin::runtime::run_source(argc, argv, quoin::sensor_bridge::replay_kind(),
                                    quoin::sensor_bridge::open_replay);
}
