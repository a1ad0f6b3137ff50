// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <idl/Control.h>
#include <mutex>
#include <optional>
#include <string>

#include "services/runtime/node/method.hpp"

namespace quoin::runtime {

/// Exchanges a node's method or parameters on request: built and validated in the control thread,
/// then put in force between two messages. The node asks with one atomic load a message. What the
/// method keeps goes over to the next one of the same form; what would be dropped is said before
/// anything is done.
class MethodExchange {
 public:
  /// `longest_wait`: for a message to apply a request at, before the answer goes out. Throws
  /// ParameterError.
  MethodExchange(std::string method, ParameterSettings parameters, MethodFactory make,
                 std::chrono::milliseconds longest_wait = std::chrono::seconds(2));

  /// Node: called before it handles message `sequence_number`; true when the method has changed.
  bool apply(std::uint64_t sequence_number);
  /// Node: the method in force.
  [[nodiscard]] const Method& method() const { return current_; }
  [[nodiscard]] const std::string& name() const { return name_; }
  /// Node: what a successor goes on with; empty when the method keeps nothing.
  [[nodiscard]] State save() const;
  /// Node: goes on with what a predecessor kept. Throws when that cannot be.
  void restore(const State& state);

  /// Answers requests to describe or exchange the method, from the control thread. Throws when the
  /// request cannot be granted; then nothing has changed.
  void handle(const msg::ControlRequest& request, msg::ControlReply& reply);

 private:
  void exchange(const std::string& method, const ParameterSettings& parameters, bool drop_state,
                msg::ControlReply& reply);

  /// What a method is known by.
  struct Version {
    std::string name;
    std::string state_form;
    ParameterSettings parameters;
  };

  [[nodiscard]] Version wanted() const;

  const MethodFactory make_;
  const std::chrono::milliseconds longest_wait_;
  // Of the node's thread.
  std::string name_;
  Method current_;

  std::atomic<bool> pending_{false};
  mutable std::mutex mutex_;
  std::condition_variable applied_;
  Version in_force_;
  Version wanted_;  // the same unless a request is pending
  std::optional<Method> next_;
  std::string refusal_;
  std::uint64_t first_sequence_number_ = 0;
};

}  // namespace quoin::runtime
