// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/viewer/foxglove_channels.hpp"

#include <memory>
#include <utility>

#include "services/topics/protobuf/schemas.hpp"

namespace quoin::viewer {

namespace {

// Viewers show what is in a frame that hangs on another one.
constexpr std::string_view root_frame = "world";

std::string base64(std::string_view bytes) {
  constexpr std::string_view digits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const auto byte = [&](std::size_t k) {
      return k < bytes.size() ? static_cast<unsigned>(static_cast<unsigned char>(bytes[k])) : 0U;
    };
    const unsigned group = byte(i) << 16 | byte(i + 1) << 8 | byte(i + 2);
    text += digits[group >> 18];
    text += digits[group >> 12 & 63];
    text += i + 1 < bytes.size() ? digits[group >> 6 & 63] : '=';
    text += i + 2 < bytes.size() ? digits[group & 63] : '=';
  }
  return text;
}

Channel protobuf_channel(std::string topic, std::string_view schema) {
  return {0,          std::move(topic),
          "protobuf", std::string(schema),
          "protobuf", base64(topics::protobuf_descriptor_set(schema))};
}

Payload payload_of(std::string bytes, std::int64_t time) {
  const auto owner = std::make_shared<const std::string>(std::move(bytes));
  return {owner, std::as_bytes(std::span(*owner)), time};
}

}  // namespace

void FoxgloveChannels::add(const std::string& topic, const std::string& type) {
  Topic made{topics::Views(type), {}};
  if (made.views.list().empty()) return;
  for (const topics::View& view : made.views.list()) {
    made.channels.push_back(
        hub_.add_channel(protobuf_channel(topic + "/" + std::string(view.name), view.schema)));
  }
  topics_.insert_or_assign(topic, std::move(made));
  if (transforms_ == 0 && type != "status") {
    transforms_ = hub_.add_channel(
        protobuf_channel(hub_.name() + "/transforms", topics::frame_transform_schema));
  }
}

void FoxgloveChannels::publish(const std::string& topic, std::span<const std::byte> cdr,
                               const std::string& frame, std::int64_t stamp) {
  const auto found = topics_.find(topic);
  if (found == topics_.end()) return;
  Topic& each = found->second;
  bool read = false;
  for (std::size_t view = 0; view < each.channels.size(); ++view) {
    if (!hub_.wanted(each.channels[view])) continue;
    if (!read && !each.views.read(cdr)) return;
    read = true;
    std::string bytes;
    if (!each.views.append(view, bytes)) continue;
    if (!frame.empty() && hub_.wanted(transforms_)) {
      hub_.publish(transforms_,
                   payload_of(topics::frame_transform(root_frame, frame, stamp, {}), stamp));
    }
    hub_.publish(each.channels[view], payload_of(std::move(bytes), stamp));
  }
}

}  // namespace quoin::viewer
