// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <future>
#include <idl/Control.h>
#include <utility>

#include "tests/services/runtime/node/stage.hpp"

namespace quoin::runtime {

[[nodiscard]] inline msg::ControlRequest request_to(msg::ControlAction action,
                                                    const Positions& positions = {}) {
  msg::ControlRequest request;
  request.action(action);
  for (const auto& [port, number] : positions) {
    msg::PortPosition& position = request.positions().emplace_back();
    position.port(port);
    position.sequence_number(number);
  }
  return request;
}

[[nodiscard]] inline Positions positions_of(const msg::ControlReply& reply) {
  Positions positions;
  for (const msg::PortPosition& position : reply.positions()) {
    positions[position.port()] = position.sequence_number();
  }
  return positions;
}

/// Of what is answered at once.
[[nodiscard]] inline msg::ControlReply answer(Stage& stage, const msg::ControlRequest& request) {
  msg::ControlReply reply;
  if (!stage.node().succession().handle(request, reply))
    throw std::logic_error("not of a succession");
  return reply;
}

/// Asks for what another thread has to do: calls `work` until the answer is there.
template <class Work>
[[nodiscard]] msg::ControlReply answer(Stage& stage, const msg::ControlRequest& request,
                                       Work work) {
  auto reply = std::async(std::launch::async, [&] { return answer(stage, request); });
  while (reply.wait_for(std::chrono::seconds(0)) != std::future_status::ready) work();
  return reply.get();
}

/// Has a process leave what is from `positions` on. It does nothing before it was asked.
[[nodiscard]] inline msg::ControlReply hand_over(Stage& stage, const Positions& positions) {
  bool left = false;
  return answer(stage, request_to(msg::ControlAction::CONTROL_HAND_OVER, positions), [&] {
    if (!stage.node().succession().asked()) return;
    stage.run();
    if (stage.node().has_left() && !std::exchange(left, true)) stage.node().leave();
  });
}

[[nodiscard]] inline msg::ControlReply hold(Stage& stage) {
  return answer(stage, request_to(msg::ControlAction::CONTROL_HOLD));
}

[[nodiscard]] inline msg::ControlReply take_over(Stage& stage, const Positions& positions,
                                                 const State& state = {}) {
  msg::ControlRequest request = request_to(msg::ControlAction::CONTROL_TAKE_OVER, positions);
  request.state(state);
  return answer(stage, request);
}

}  // namespace quoin::runtime
