// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace quoin::viewer {

/// The frames of Foxglove's WebSocket protocol, version 1: texts are JSON with "op", binary frames
/// begin with an opcode and are little-endian. https://github.com/foxglove/ws-protocol
///
/// Both names of it are spoken; the newer one differs in operations that are not offered here.
inline constexpr std::array<std::string_view, 2> subprotocols{"foxglove.sdk.v1",
                                                              "foxglove.websocket.v1"};

/// A topic as clients see it.
struct Channel {
  std::uint32_t id = 0;
  std::string topic;
  std::string encoding;         ///< of its messages: "cdr", "protobuf", "json"
  std::string schema_name;      ///< "quoin::msg::Scan"
  std::string schema_encoding;  ///< "omgidl", "protobuf"
  std::string schema;           ///< text, or base64 of a FileDescriptorSet
};

/// Bytes that several clients share, with whatever keeps them alive.
struct Payload {
  std::shared_ptr<const void> owner;
  std::span<const std::byte> bytes;
  std::int64_t time = 0;  ///< [ns since the Unix epoch]
};

enum class StatusLevel { info = 0, warning = 1, error = 2 };

[[nodiscard]] std::string server_info(std::string_view name, std::string_view session);
[[nodiscard]] std::string advertisement(std::span<const Channel> channels);
/// Services take and give JSON. Their ids count from 1 in this order.
[[nodiscard]] std::string service_advertisement(std::span<const std::string> names);
[[nodiscard]] std::string status(StatusLevel level, std::string_view message);
[[nodiscard]] std::string service_failure(std::uint32_t service, std::uint32_t call,
                                          std::string_view message);
[[nodiscard]] std::string service_response(std::uint32_t service, std::uint32_t call,
                                           std::string_view json);
/// What goes before the bytes of a message.
[[nodiscard]] std::string message_head(std::uint32_t subscription, std::int64_t time);

struct Subscription {
  std::uint32_t id = 0;  ///< chosen by the client
  std::uint32_t channel = 0;
};
struct Subscribe {
  std::vector<Subscription> subscriptions;
};
struct Unsubscribe {
  std::vector<std::uint32_t> subscriptions;
};
struct ServiceCall {
  std::uint32_t service = 0;
  std::uint32_t call = 0;
  std::string encoding;
  std::string request;
};
/// An operation of the protocol that is not offered here.
struct NotOffered {
  std::string operation;
};
using Request = std::variant<Subscribe, Unsubscribe, ServiceCall, NotOffered>;

/// What a client sent is no frame of the protocol.
class ProtocolError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Both throw ProtocolError.
[[nodiscard]] Request parse_text(std::string_view text);
[[nodiscard]] Request parse_binary(std::string_view bytes);

}  // namespace quoin::viewer
