// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "services/viewer/protocol.hpp"

namespace quoin::viewer {

/// What is to be sent as one WebSocket frame: `head`, then the bytes of `payload`.
struct Frame {
  bool text = false;
  std::string head;
  Payload payload = {};

  [[nodiscard]] std::size_t size() const { return head.size() + payload.bytes.size(); }
};

struct ClientLimits {
  std::size_t queued_bytes = 10'000'000;  ///< of messages that wait to be sent
  std::size_t subscriptions = 1000;
  std::size_t control_frames = 100;  ///< that wait to be sent
};

/// One client, whatever it is connected by: what it wants, and what waits to be sent to it. Other
/// threads offer messages; they never wait, and what is too much is dropped: the oldest of the same
/// channel first. The client is told what was.
class Client {
 public:
  /// Answers a call with JSON; throws std::exception to refuse it.
  using Service = std::function<std::string(std::string_view name, const std::string& request)>;

  /// `topics`: of the channels, whose ids count from 1. `greeting`: the texts that it gets first.
  Client(std::vector<std::string> topics, std::vector<std::string> services,
         const std::vector<std::string>& greeting, ClientLimits limits = {});

  /// A frame of the client. What it may see at once is offered by `subscribed`, by channel.
  /// Throws ProtocolError for what is none; then the connection is to be closed.
  void receive_text(std::string_view text, const std::function<void(std::uint32_t)>& subscribed);
  void receive_binary(std::string_view bytes, const Service& call);

  /// A channel that came later, with the next id.
  void advertise(const Channel& channel);

  /// A message of that channel. True when the queue was empty before, so that somebody has to ask
  /// for the next frame.
  bool offer(std::uint32_t channel, const Payload& payload);

  [[nodiscard]] bool wants(std::uint32_t channel) const;

  /// The next frame to send.
  [[nodiscard]] std::optional<Frame> next();

  /// Whether it lets answers pile up: to be disconnected.
  [[nodiscard]] bool flooded() const;
  [[nodiscard]] std::uint64_t dropped() const;
  [[nodiscard]] std::size_t queued_bytes() const;

 private:
  struct Queued {
    std::uint32_t channel;
    Frame frame;
  };

  void handle(const Subscribe& request, std::vector<std::uint32_t>& added);
  void handle(const Unsubscribe& request);
  void control(std::string text, bool is_text = true);
  void make_room(std::uint32_t channel, std::size_t size);
  void erase(const std::deque<Queued>::iterator& queued);
  void report_drops();

  const ClientLimits limits_;
  std::vector<std::string> topics_;  // of the channels
  const std::vector<std::string> services_;
  mutable std::mutex mutex_;
  std::map<std::uint32_t, std::uint32_t> subscriptions_;  // by channel
  std::deque<Frame> control_;
  std::deque<Queued> messages_;
  std::size_t queued_bytes_ = 0;
  std::map<std::uint32_t, std::uint64_t> unreported_;  // drops by channel
  std::uint64_t dropped_ = 0;
  std::size_t until_report_ = 0;  // frames
};

}  // namespace quoin::viewer
