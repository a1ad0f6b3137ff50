// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "sensor_bridge/rplidar/emulator/link.hpp"
#include "sensor_bridge/rplidar/emulator/socket_address.hpp"
#include "sensor_bridge/transport/file_descriptor.hpp"

namespace quoin::sensor_bridge::rplidar {

/// A serial server: passes bytes on as they are, for one client at a time. The next one is served
/// when the first has closed its connection.
class TcpServer : public Link {
 public:
  TcpServer(const SocketAddress& address, Report report);

  void plug_in() override;
  void unplug() override;
  [[nodiscard]] bool plugged_in() const override { return static_cast<bool>(listener_); }
  [[nodiscard]] std::string endpoint() const override { return "tcp://" + address_.text(); }
  void watch(std::vector<pollfd>& descriptors) const override;
  void read(std::vector<std::uint8_t>& bytes) override;
  void write(std::span<const std::uint8_t> bytes, TimePoint now) override;

 private:
  void accept_client();

  SocketAddress address_;
  Report report_;
  FileDescriptor listener_;
  FileDescriptor client_;
};

}  // namespace quoin::sensor_bridge::rplidar
