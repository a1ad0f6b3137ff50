// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "sensor_bridge/rplidar/emulator/tcp_server.hpp"

#include <array>
#include <cerrno>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>
#include <system_error>
#include <utility>

namespace quoin::sensor_bridge::rplidar {

TcpServer::TcpServer(const SocketAddress& address, Report report)
    : address_(address), report_(std::move(report)) {}

void TcpServer::plug_in() {
  FileDescriptor listener = bound_socket(SOCK_STREAM, address_);
  if (::listen(listener.get(), 1) != 0) {
    throw std::system_error(errno, std::generic_category(), "cannot listen on " + address_.text());
  }
  address_ = SocketAddress::of(listener.get());  // the kernel's choice is kept from now on
  listener_ = std::move(listener);
}

void TcpServer::unplug() {
  client_.reset();
  listener_.reset();
}

void TcpServer::watch(std::vector<pollfd>& descriptors) const {
  if (client_) {
    descriptors.push_back({client_.get(), POLLIN, 0});
  } else if (listener_) {
    descriptors.push_back({listener_.get(), POLLIN, 0});
  }
}

void TcpServer::accept_client() {
  SocketAddress peer;
  FileDescriptor client(
      ::accept4(listener_.get(), peer.get(), peer.size_to_fill(), SOCK_NONBLOCK | SOCK_CLOEXEC));
  if (!client) return;
  const int yes = 1;  // of no effect on what arrives, only on when
  (void)::setsockopt(client.get(), IPPROTO_TCP, TCP_NODELAY, &yes, sizeof yes);
  // Not much more than a serial server holds back, so that a client that does not read loses bytes.
  const int buffer = 4096;
  (void)::setsockopt(client.get(), SOL_SOCKET, SO_SNDBUF, &buffer, sizeof buffer);
  client_ = std::move(client);
  report_("client " + peer.text() + " connected");
}

void TcpServer::read(std::vector<std::uint8_t>& bytes) {
  if (listener_ && !client_) accept_client();
  if (!client_) return;
  std::array<std::uint8_t, 1024> piece;
  const ssize_t size = ::recv(client_.get(), piece.data(), piece.size(), 0);
  if (size > 0) {
    bytes.insert(bytes.end(), piece.begin(), piece.begin() + size);
  } else if (size == 0 || (errno != EAGAIN && errno != EINTR)) {
    client_.reset();
    report_("client disconnected");
  }
}

void TcpServer::write(std::span<const std::uint8_t> bytes, TimePoint /*now*/) {
  if (bytes.empty()) return;
  const ssize_t size =
      client_ ? ::send(client_.get(), bytes.data(), bytes.size(), MSG_NOSIGNAL) : 0;
  count(bytes.size(), size > 0 ? static_cast<std::size_t>(size) : 0);
}

}  // namespace quoin::sensor_bridge::rplidar
