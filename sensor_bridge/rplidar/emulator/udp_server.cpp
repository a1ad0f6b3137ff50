// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "sensor_bridge/rplidar/emulator/udp_server.hpp"

#include <array>
#include <sys/socket.h>
#include <utility>

#include "sensor_bridge/rplidar/protocol/request.hpp"

namespace quoin::sensor_bridge::rplidar {
namespace {

// Gathers a few capsules for a datagram.
constexpr std::chrono::milliseconds longest_wait{10};

}  // namespace

UdpServer::UdpServer(const SocketAddress& address, Report report)
    : address_(address), report_(std::move(report)) {}

void UdpServer::plug_in() {
  FileDescriptor socket = bound_socket(SOCK_DGRAM, address_);
  address_ = SocketAddress::of(socket.get());  // the kernel's choice is kept from now on
  socket_ = std::move(socket);
}

void UdpServer::unplug() {
  socket_.reset();
  client_ = SocketAddress();
  waiting_.clear();
}

void UdpServer::watch(std::vector<pollfd>& descriptors) const {
  if (socket_) descriptors.push_back({socket_.get(), POLLIN, 0});
}

void UdpServer::read(std::vector<std::uint8_t>& bytes) {
  if (!socket_) return;
  std::array<std::uint8_t, largest_datagram> datagram;
  SocketAddress sender;
  const ssize_t size = ::recvfrom(socket_.get(), datagram.data(), datagram.size(), 0, sender.get(),
                                  sender.size_to_fill());
  if (size < 0) return;
  if (sender.text() != client_.text()) {
    // Strays come to every port: announcements of DDS, for one. They take the stream from no
    // client.
    if (size == 0 || datagram[0] != request_sync) return;
    report_("client " + sender.text());
    count(waiting_.size(), 0);  // was for another one
    waiting_.clear();
  }
  client_ = sender;
  bytes.insert(bytes.end(), datagram.begin(), datagram.begin() + size);
}

void UdpServer::write(std::span<const std::uint8_t> bytes, TimePoint now) {
  if (waiting_.empty()) waiting_since_ = now;
  waiting_.insert(waiting_.end(), bytes.begin(), bytes.end());
  while (waiting_.size() >= largest_datagram) send_datagram(largest_datagram);
  if (!waiting_.empty() && now >= waiting_since_ + longest_wait) send_datagram(waiting_.size());
}

std::optional<UdpServer::TimePoint> UdpServer::next_write() const {
  if (waiting_.empty()) return std::nullopt;
  return waiting_since_ + longest_wait;
}

void UdpServer::send_datagram(std::size_t size) {
  const ssize_t sent = client_.size() == 0 ? 0
                                           : ::sendto(socket_.get(), waiting_.data(), size,
                                                      MSG_NOSIGNAL, client_.get(), client_.size());
  count(size, sent > 0 ? static_cast<std::size_t>(sent) : 0);
  waiting_.erase(waiting_.begin(), waiting_.begin() + static_cast<std::ptrdiff_t>(size));
}

}  // namespace quoin::sensor_bridge::rplidar
