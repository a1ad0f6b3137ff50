// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "sensor_bridge/transport/network.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <netdb.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <string>
#include <sys/socket.h>
#include <utility>
#include <vector>

#include "sensor_bridge/transport/file_stream.hpp"

namespace quoin::sensor_bridge {
namespace {

using Clock = std::chrono::steady_clock;
using Addresses = std::unique_ptr<addrinfo, decltype(&::freeaddrinfo)>;

Addresses addresses_of(const Endpoint& endpoint, int type) {
  addrinfo hints{};
  hints.ai_socktype = type;
  hints.ai_flags = AI_NUMERICSERV;
  addrinfo* found = nullptr;
  const int status =
      ::getaddrinfo(endpoint.host.c_str(), std::to_string(endpoint.port).c_str(), &hints, &found);
  if (status == EAI_SYSTEM) throw system_error(to_text(endpoint), "look up the host", errno);
  if (status != 0) {
    throw TransportError(TransportError::Kind::unknown_host,
                         to_text(endpoint) + ": unknown host: " + ::gai_strerror(status));
  }
  return {found, &::freeaddrinfo};
}

/// Connects within the deadline; otherwise `error` is why not.
FileDescriptor connect_to(const addrinfo& address, Deadline deadline, int& error) {
  FileDescriptor descriptor(::socket(
      address.ai_family, address.ai_socktype | SOCK_NONBLOCK | SOCK_CLOEXEC, address.ai_protocol));
  const int socket = descriptor.get();
  error = 0;
  if (socket < 0 || (::connect(socket, address.ai_addr, address.ai_addrlen) < 0)) error = errno;
  if (error != EINPROGRESS) return descriptor;
  if (!wait_for(socket, POLLOUT, deadline)) {
    error = ETIMEDOUT;
    return descriptor;
  }
  socklen_t size = sizeof(error);
  if (::getsockopt(socket, SOL_SOCKET, SO_ERROR, &error, &size) < 0) error = errno;
  return descriptor;
}

FileDescriptor connect_first(const Endpoint& endpoint, int type, Deadline deadline) {
  const Addresses addresses = addresses_of(endpoint, type);
  int first_error = 0;
  for (const addrinfo* address = addresses.get(); address; address = address->ai_next) {
    int error = 0;
    FileDescriptor descriptor = connect_to(*address, deadline, error);
    if (error == 0) return descriptor;
    if (first_error == 0) first_error = error;
  }
  throw system_error(to_text(endpoint), "connect", first_error);
}

class TcpConnection final : public FileStream {
 public:
  using FileStream::FileStream;

 private:
  long put(std::span<const std::uint8_t> bytes) override {
    return ::send(descriptor(), bytes.data(), bytes.size(), MSG_NOSIGNAL);
  }
};

class UdpConnection final : public Transport {
 public:
  UdpConnection(FileDescriptor descriptor, std::string name)
      : descriptor_(std::move(descriptor)), name_(std::move(name)) {}

  std::size_t read(std::span<std::uint8_t> bytes, Deadline deadline) override {
    // What does not fit into `bytes` would be lost: a datagram is received as a whole.
    while (begin_ == end_) {
      if (!wait_for(descriptor_.get(), POLLIN, deadline)) return 0;
      receive();
      if (begin_ == end_ && Clock::now() >= deadline) return 0;
    }
    const std::size_t count = std::min(bytes.size(), end_ - begin_);
    std::copy_n(datagram_.begin() + static_cast<std::ptrdiff_t>(begin_), count, bytes.begin());
    begin_ += count;
    return count;
  }

  void write(std::span<const std::uint8_t> bytes, Deadline deadline) override {
    while (::send(descriptor_.get(), bytes.data(), bytes.size(), MSG_NOSIGNAL) < 0) {
      if (errno != EAGAIN && errno != EINTR) throw system_error(name_, "send", errno);
      if (!wait_for(descriptor_.get(), POLLOUT, deadline) || Clock::now() > deadline) {
        throw TransportError(TransportError::Kind::timed_out, name_ + ": takes no datagram");
      }
    }
  }

  void discard_input() override {
    begin_ = end_ = 0;
    for (int datagram = 0; datagram < 1024 && wait_for(descriptor_.get(), POLLIN, Deadline{});
         ++datagram) {
      receive();
    }
    begin_ = end_ = 0;
  }

 private:
  void receive() {
    const ssize_t count = ::recv(descriptor_.get(), datagram_.data(), datagram_.size(), 0);
    if (count < 0 && errno != EAGAIN && errno != EINTR) throw system_error(name_, "receive", errno);
    begin_ = 0;
    end_ = static_cast<std::size_t>(std::max<ssize_t>(count, 0));
  }

  FileDescriptor descriptor_;
  std::string name_;
  std::vector<std::uint8_t> datagram_ = std::vector<std::uint8_t>(65536);
  std::size_t begin_ = 0;  // what is left of the datagram
  std::size_t end_ = 0;
};

}  // namespace

std::unique_ptr<Transport> connect_tcp(const Endpoint& endpoint,
                                       std::chrono::milliseconds time_out) {
  FileDescriptor descriptor = connect_first(endpoint, SOCK_STREAM, Clock::now() + time_out);
  const int socket = descriptor.get();
  const int on = 1;
  // Requests are a few bytes each; they must not wait for one another.
  (void)::setsockopt(socket, IPPROTO_TCP, TCP_NODELAY, &on, sizeof(on));
  return std::make_unique<TcpConnection>(std::move(descriptor), to_text(endpoint));
}

std::unique_ptr<Transport> connect_udp(const Endpoint& endpoint) {
  return std::make_unique<UdpConnection>(connect_first(endpoint, SOCK_DGRAM, Deadline::max()),
                                         to_text(endpoint));
}

}  // namespace quoin::sensor_bridge
