// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>

#include "sensor_bridge/transport/file_descriptor.hpp"
#include "sensor_bridge/transport/transport.hpp"

namespace quoin::sensor_bridge {

/// Waits for an event of poll(): true when it, an error or a hang-up has come before the deadline.
[[nodiscard]] bool wait_for(int descriptor, short event, Deadline deadline);

/// What serial ports and TCP connections have in common: a non-blocking descriptor whose bytes are
/// read and written without regard to where they are cut.
class FileStream : public Transport {
 public:
  FileStream(FileDescriptor descriptor, std::string name)
      : descriptor_(std::move(descriptor)), name_(std::move(name)) {}

  [[nodiscard]] std::size_t read(std::span<std::uint8_t> bytes, Deadline deadline) override;
  void write(std::span<const std::uint8_t> bytes, Deadline deadline) override;
  void discard_input() override;

 protected:
  [[nodiscard]] int descriptor() const { return descriptor_.get(); }

 private:
  /// 0 from read() is the end of a connection, but with a serial port may be nothing to read.
  [[nodiscard]] virtual bool at_end() const { return true; }
  /// As write() of the system.
  [[nodiscard]] virtual long put(std::span<const std::uint8_t> bytes) = 0;

  FileDescriptor descriptor_;
  std::string name_;
  Deadline last_read_{};
};

}  // namespace quoin::sensor_bridge
