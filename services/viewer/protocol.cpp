// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/viewer/protocol.hpp"

#include <limits>

#include <nlohmann/json.hpp>

namespace quoin::viewer {

namespace {

using nlohmann::json;

constexpr char message_opcode = 1;
constexpr char service_opcode = 3;     // of a response
constexpr char call_opcode = 2;        // of a client
constexpr std::size_t call_head = 13;  // opcode and three numbers

std::string dumped(const json& object) {
  return object.dump(-1, ' ', false, json::error_handler_t::replace);
}

template <class T>
void append(std::string& bytes, T value) {
  for (std::size_t i = 0; i < sizeof(T); ++i) {
    bytes += static_cast<char>(static_cast<std::uint64_t>(value) >> (8 * i) & 0xFFU);
  }
}

std::uint32_t number_at(std::string_view bytes, std::size_t offset) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    value |= static_cast<std::uint32_t>(static_cast<unsigned char>(bytes[offset + i])) << (8 * i);
  }
  return value;
}

/// A number of 32 bits, as all ids are.
std::uint32_t id_of(const json& value, const char* what) {
  if (!value.is_number_integer()) throw ProtocolError(std::string(what) + " is not an integer");
  const auto wide = value.is_number_unsigned() ? value.get<std::uint64_t>() : std::uint64_t(-1);
  if (wide > std::numeric_limits<std::uint32_t>::max()) {
    throw ProtocolError(std::string(what) + " is not between 0 and 4294967295");
  }
  return static_cast<std::uint32_t>(wide);
}

const json& list_of(const json& object, const char* key) {
  const auto found = object.find(key);
  if (found == object.end() || !found->is_array()) {
    throw ProtocolError(std::string("'") + key + "' is not a list");
  }
  return *found;
}

Subscribe parse_subscribe(const json& object) {
  Subscribe result;
  for (const json& each : list_of(object, "subscriptions")) {
    if (!each.is_object() || !each.contains("id") || !each.contains("channelId")) {
      throw ProtocolError("a subscription needs 'id' and 'channelId'");
    }
    result.subscriptions.push_back(
        {id_of(each["id"], "id"), id_of(each["channelId"], "channelId")});
  }
  return result;
}

Unsubscribe parse_unsubscribe(const json& object) {
  Unsubscribe result;
  for (const json& each : list_of(object, "subscriptionIds")) {
    result.subscriptions.push_back(id_of(each, "a subscription id"));
  }
  return result;
}

}  // namespace

std::string server_info(std::string_view name, std::string_view session) {
  return dumped({{"op", "serverInfo"},
                 {"name", name},
                 {"capabilities", {"services"}},
                 {"supportedEncodings", {"json"}},
                 {"metadata", json::object()},
                 {"sessionId", session}});
}

std::string advertisement(std::span<const Channel> channels) {
  json list = json::array();
  for (const Channel& channel : channels) {
    list.push_back({{"id", channel.id},
                    {"topic", channel.topic},
                    {"encoding", channel.encoding},
                    {"schemaName", channel.schema_name},
                    {"schemaEncoding", channel.schema_encoding},
                    {"schema", channel.schema}});
  }
  return dumped({{"op", "advertise"}, {"channels", std::move(list)}});
}

std::string service_advertisement(std::span<const std::string> names) {
  json list = json::array();
  for (const std::string& name : names) {
    const json schema{
        {"encoding", "json"}, {"schemaName", ""}, {"schemaEncoding", ""}, {"schema", ""}};
    list.push_back({{"id", list.size() + 1},
                    {"name", name},
                    {"type", name},
                    {"request", schema},
                    {"response", schema}});
  }
  return dumped({{"op", "advertiseServices"}, {"services", std::move(list)}});
}

std::string status(StatusLevel level, std::string_view message) {
  return dumped({{"op", "status"}, {"level", static_cast<int>(level)}, {"message", message}});
}

std::string service_failure(std::uint32_t service, std::uint32_t call, std::string_view message) {
  return dumped({{"op", "serviceCallFailure"},
                 {"serviceId", service},
                 {"callId", call},
                 {"message", message}});
}

std::string service_response(std::uint32_t service, std::uint32_t call, std::string_view json) {
  constexpr std::string_view encoding = "json";
  std::string bytes(1, service_opcode);
  append(bytes, service);
  append(bytes, call);
  append(bytes, static_cast<std::uint32_t>(encoding.size()));
  bytes += encoding;
  bytes += json;
  return bytes;
}

std::string message_head(std::uint32_t subscription, std::int64_t time) {
  std::string bytes(1, message_opcode);
  append(bytes, subscription);
  append(bytes, time);
  return bytes;
}

Request parse_text(std::string_view text) {
  const json object = json::parse(text, nullptr, false);
  if (!object.is_object()) throw ProtocolError("a text frame is not a JSON object");
  const auto operation = object.find("op");
  if (operation == object.end() || !operation->is_string()) {
    throw ProtocolError("a text frame has no 'op'");
  }
  const auto& name = operation->get_ref<const std::string&>();
  if (name == "subscribe") return parse_subscribe(object);
  if (name == "unsubscribe") return parse_unsubscribe(object);
  return NotOffered{name.substr(0, 64)};
}

Request parse_binary(std::string_view bytes) {
  if (bytes.empty()) throw ProtocolError("an empty binary frame");
  if (bytes.front() != call_opcode) {
    return NotOffered{"binary " + std::to_string(static_cast<unsigned char>(bytes.front()))};
  }
  if (bytes.size() < call_head) throw ProtocolError("a service call is cut short");
  const std::uint32_t length = number_at(bytes, 9);
  if (length > bytes.size() - call_head) throw ProtocolError("a service call is cut short");
  return ServiceCall{number_at(bytes, 1), number_at(bytes, 5),
                     std::string(bytes.substr(call_head, length)),
                     std::string(bytes.substr(call_head + length))};
}

}  // namespace quoin::viewer
