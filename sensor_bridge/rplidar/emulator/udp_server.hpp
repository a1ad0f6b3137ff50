// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "sensor_bridge/rplidar/emulator/link.hpp"
#include "sensor_bridge/rplidar/emulator/socket_address.hpp"
#include "sensor_bridge/transport/file_descriptor.hpp"

namespace quoin::sensor_bridge::rplidar {

/// The byte stream in datagrams, to whoever has made a request last.
class UdpServer : public Link {
 public:
  /// What clients have room for.
  static constexpr std::size_t largest_datagram = 1024;  // [byte]

  UdpServer(const SocketAddress& address, Report report);

  void plug_in() override;
  void unplug() override;
  [[nodiscard]] bool plugged_in() const override { return static_cast<bool>(socket_); }
  [[nodiscard]] std::string endpoint() const override { return "udp://" + address_.text(); }
  void watch(std::vector<pollfd>& descriptors) const override;
  void read(std::vector<std::uint8_t>& bytes) override;
  void write(std::span<const std::uint8_t> bytes, TimePoint now) override;
  [[nodiscard]] std::optional<TimePoint> next_write() const override;

 private:
  void send_datagram(std::size_t size);

  SocketAddress address_;
  Report report_;
  FileDescriptor socket_;
  SocketAddress client_;
  std::vector<std::uint8_t> waiting_;
  TimePoint waiting_since_{};
};

}  // namespace quoin::sensor_bridge::rplidar
