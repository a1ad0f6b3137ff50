// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "sensor_bridge/rplidar/emulator/emulator.hpp"

namespace quoin::sensor_bridge::rplidar {

/// Executes what is typed: a fault, `clear` (ends all faults), `status`, `help` or `quit`.
/// Returns what to print, "" for nothing; `quit` becomes true when it is to end.
[[nodiscard]] std::string carry_out(Emulator& emulator, std::string_view line, bool& quit);

/// Carries out the lines of standard input and prints the answers until `quit` is typed or the
/// process is ended by SIGINT or SIGTERM, which must be blocked in all threads. The end of
/// the input ends nothing.
void run_console(Emulator& emulator, const std::function<void(const std::string&)>& print);

}  // namespace quoin::sensor_bridge::rplidar
