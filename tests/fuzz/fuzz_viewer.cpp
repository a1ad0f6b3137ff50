// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
//
// What a client of the live view may send, as frames of a conversation: each begins with its kind
// and its length.
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "services/viewer/access.hpp"
#include "services/viewer/hub.hpp"
#include "tests/fuzz/require.hpp"

using namespace quoin::viewer;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::string_view left(reinterpret_cast<const char*>(data), size);
  Hub hub("robot");
  hub.limit(2, {.queued_bytes = 1000, .subscriptions = 3, .control_frames = 20});
  hub.add_channel({0, "front/scan", "cdr", "", "", ""});
  hub.add_channel({0, "walls/segments", "cdr", "", "", ""});
  hub.add_service("echo", [](const std::string& request) { return request; });
  const auto client = hub.connect([] {});
  const auto owner = std::make_shared<const std::string>(300, 'x');
  const Payload payload{owner, std::as_bytes(std::span(*owner)), 1};
  while (left.size() >= 2) {
    const auto kind = static_cast<unsigned char>(left[0]);
    const std::string_view frame = left.substr(2, static_cast<unsigned char>(left[1]));
    left.remove_prefix(2 + frame.size());
    try {
      if (kind % 4 == 0) hub.receive_text(*client, frame);
      if (kind % 4 == 1) hub.receive_binary(*client, frame);
    } catch (const ProtocolError&) {
      break;  // the connection is closed
    }
    if (kind % 4 == 2) hub.publish(1 + kind / 4 % 3, payload);
    if (kind % 4 == 3) {
      const auto next = client->next();
      quoin::fuzz::require(!next || !next->head.empty(), "frames have a head");
    }
    quoin::fuzz::require(client->queued_bytes() <= 1000, "the queue is bounded");
    if (client->flooded()) break;
  }
  // The same bytes as what a request says of itself.
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const AccessRules rules{{"robot.local"}, {"https://app.foxglove.dev"}, "0123456789abcdef"};
  const std::size_t half = text.size() / 2;
  const Caller caller{text.substr(0, half), text.substr(half), text, text};
  const bool in = may_connect(rules, caller) == Refusal::none;
  quoin::fuzz::require(!in || text.find(rules.token) != std::string_view::npos,
                       "nobody gets in without the token");
  return 0;
}
