// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "sensor_bridge/rplidar/emulator/link.hpp"
#include "sensor_bridge/transport/file_descriptor.hpp"

namespace quoin::sensor_bridge::rplidar {

/// A pseudo-terminal instead of a serial port. A client sets baud rate and mode as on a real one.
/// Each time it is plugged in it has another name; the symbolic link stays the same.
class PseudoTerminal : public Link {
 public:
  /// `link` is where the symbolic link is made; "" for none.
  PseudoTerminal(std::filesystem::path link, Report report);
  ~PseudoTerminal() override;

  void plug_in() override;
  void unplug() override;
  [[nodiscard]] bool plugged_in() const override { return static_cast<bool>(master_); }
  [[nodiscard]] std::string endpoint() const override;
  void watch(std::vector<pollfd>& descriptors) const override;
  void read(std::vector<std::uint8_t>& bytes) override;
  void write(std::span<const std::uint8_t> bytes, TimePoint now) override;
  [[nodiscard]] std::optional<unsigned> baud_rate() const override;

 private:
  void follow_clients();
  void make_link() const;
  void remove_link() const;

  std::filesystem::path link_;
  Report report_;
  FileDescriptor master_;
  /// Without it the terminal would forget its mode whenever no client is there.
  FileDescriptor slave_;
  FileDescriptor openings_;  ///< readable when clients open and close the terminal
  int clients_ = 0;
  std::filesystem::path slave_path_;
};

}  // namespace quoin::sensor_bridge::rplidar
