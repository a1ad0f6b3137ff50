// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace quoin::sensor_bridge {

/// Manufacturer and model of an adapter.
struct UsbIdentity {
  std::uint16_t vendor = 0;
  std::uint16_t product = 0;
  std::string product_name;
  std::string serial_number;

  friend bool operator==(const UsbIdentity&, const UsbIdentity&) = default;
};

/// A serial port at which a device may be.
struct SerialPortEntry {
  std::string device;  ///< such as /dev/ttyUSB0; changes with the order of plugging in
  std::string link;    ///< below /dev/serial/by-id, stays the same; empty without udev
  std::optional<UsbIdentity> usb;

  /// By which it is found again when it was plugged out.
  [[nodiscard]] const std::string& name() const { return link.empty() ? device : link; }

  friend bool operator==(const SerialPortEntry&, const SerialPortEntry&) = default;
};

/// The adapter inside most of the vendor's USB cables (Silicon Labs CP210x).
[[nodiscard]] bool is_usual_adapter(const UsbIdentity& usb);

/// All /dev/ttyUSB* and /dev/ttyACM*, usual adapters first, then by name. `root` is where the
/// system is looked at; the names begin at it.
[[nodiscard]] std::vector<SerialPortEntry> list_serial_ports(
    const std::filesystem::path& root = "/");

/// Those of them that are usual adapters.
[[nodiscard]] std::vector<SerialPortEntry> usual_adapters(std::vector<SerialPortEntry> ports);

}  // namespace quoin::sensor_bridge
