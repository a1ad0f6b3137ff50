// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "services/viewer/client.hpp"

namespace quoin::viewer {

/// The channels, their newest messages and the clients. Any thread publishes; it waits for nobody.
class Hub {
 public:
  /// Answers a request (JSON) with JSON; throws std::exception to refuse it.
  using Service = std::function<std::string(const std::string& request)>;

  explicit Hub(std::string name) : name_(std::move(name)) {}
  Hub(const Hub&) = delete;
  Hub& operator=(const Hub&) = delete;

  /// Returns the id of the channel; ids count from 1. Clients that are there already hear of it.
  std::uint32_t add_channel(Channel channel);
  /// Before the first client.
  void add_service(std::string name, Service service);

  /// The newest message of each channel, of each key where there are several, is kept for clients
  /// that come later.
  void publish(std::uint32_t channel, Payload payload, std::uint64_t key = 0);

  /// Whether a client has subscribed to it.
  [[nodiscard]] bool wanted(std::uint32_t channel) const;

  /// A client that is greeted already. `wake` is called, from any thread, when it has something to
  /// send after there was nothing. Null when there are too many.
  [[nodiscard]] std::shared_ptr<Client> connect(std::function<void()> wake);
  void disconnect(const Client& client);

  /// Frames of a client. Throw ProtocolError.
  void receive_text(Client& client, std::string_view text);
  void receive_binary(Client& client, std::string_view bytes);

  struct Figures {
    std::size_t clients = 0;
    std::uint64_t dropped = 0;  ///< messages, of all clients so far
  };
  [[nodiscard]] Figures figures() const;
  [[nodiscard]] const std::string& name() const { return name_; }
  /// [clients] More are refused.
  void limit(std::size_t most_clients, ClientLimits limits);

 private:
  struct Connected {
    std::shared_ptr<Client> client;
    std::function<void()> wake;
  };

  const std::string name_;
  const std::string session_ = std::to_string(now());
  mutable std::mutex mutex_;
  std::vector<Channel> channels_;
  std::vector<std::map<std::uint64_t, Payload>> newest_;  // by channel and key
  std::vector<std::string> service_names_;
  std::vector<Service> services_;
  std::vector<Connected> clients_;
  std::uint64_t dropped_ = 0;  // of clients that are gone
  std::size_t most_clients_ = 16;
  ClientLimits limits_;

  [[nodiscard]] static std::int64_t now();
};

}  // namespace quoin::viewer
