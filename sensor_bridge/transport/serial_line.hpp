// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

namespace quoin::sensor_bridge {

// The system's terminal interface with free baud rates. Its header and <termios.h> exclude each
// other, so that it is kept behind these functions. They return 0 or the value of errno.

/// 8 data bits, no parity, one stop bit, no flow control, every byte as it is; reads do not wait.
[[nodiscard]] int set_raw_mode(int descriptor, unsigned baud_rate);
/// The rate in use, which an adapter may have rounded; nothing when it is no serial port (any
/// more).
[[nodiscard]] std::optional<unsigned> baud_rate_of(int descriptor);
/// Other programs of other users cannot open the port any more, or can again.
[[nodiscard]] int set_exclusive(int descriptor, bool exclusive);
[[nodiscard]] int set_terminal_ready(int descriptor, bool ready);
[[nodiscard]] int flush_input(int descriptor);

}  // namespace quoin::sensor_bridge
