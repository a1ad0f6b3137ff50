// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include <CLI/CLI.hpp>

#include "sensor_bridge/rplidar/emulator/emulator_settings.hpp"

namespace quoin::sensor_bridge::rplidar {

struct CommandLine {
  EmulatorSettings settings;
  bool quiet = false;
};

/// Adds the emulator's options; what they are set to is in `line` after parsing.
void add_options(CLI::App& app, CommandLine& line);

}  // namespace quoin::sensor_bridge::rplidar
