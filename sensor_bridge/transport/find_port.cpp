// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "sensor_bridge/transport/find_port.hpp"

#include <string>
#include <vector>

#include "sensor_bridge/transport/serial_ports.hpp"

namespace quoin::sensor_bridge {

Endpoint find_endpoint(std::string_view text, const std::filesystem::path& root) {
  if (text != "auto") return parse_endpoint(text);
  const std::vector<SerialPortEntry> ports = list_serial_ports(root);
  const std::vector<SerialPortEntry> usual = usual_adapters(ports);
  if (usual.size() == 1) return parse_endpoint(usual[0].name());
  if (ports.empty()) {
    throw EndpointError(
        "no USB serial port is there; plug the device in, or name its serial_port, "
        "tcp://host or udp://host");
  }
  std::string names;
  for (const SerialPortEntry& port : ports) {
    names += (names.empty() ? "" : ", ") + port.name();
  }
  throw EndpointError(std::string(usual.empty() ? "no USB serial adapter of the usual type is there"
                                                : "several devices may be meant") +
                      "; name the serial_port, one of: " + names);
}

}  // namespace quoin::sensor_bridge
