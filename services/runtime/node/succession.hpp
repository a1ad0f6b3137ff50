// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <idl/Control.h>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>

#include "services/runtime/node/method.hpp"

namespace quoin::runtime {

/// By port, a sequence number. The scans that a source makes have the port "", outputs at their own
/// rate their output_key.
using Positions = std::map<std::string, std::uint64_t>;

/// Comes behind all ports. A successor goes on with the numbers of such an output: readers that are
/// replaced with it know by them what they have.
[[nodiscard]] inline std::string output_key(std::string_view type) {
  return "~" + std::string(type);
}

/// How the work of a service goes from one process to the next without a message lost or doubled.
///
/// The successor is started held: it reads but does not publish. Asked to hold, it keeps the newest
/// message of each `each` port and all that follow. Then the predecessor is asked to hand over: it
/// handles the messages before the ones kept, makes sure that its results have arrived, and names
/// the first message of each port that it leaves, with the state of its method. From those on the
/// successor publishes.
class Succession {
 public:
  /// `longest_handover`: for the predecessor to come to what it is to leave. A source may have to
  /// let a motor stop before it releases its device.
  explicit Succession(bool held,
                      std::chrono::milliseconds longest_handover = std::chrono::seconds(5))
      : longest_handover_(longest_handover), held_(held) {}

  /// Whether this process waits to take over.
  [[nodiscard]] bool held() const { return held_.load(std::memory_order_acquire); }

  /// Answers the three requests of a succession, from the control thread; false for any other.
  /// Throws std::runtime_error when the request cannot be granted.
  bool handle(const msg::ControlRequest& request, msg::ControlReply& reply);
  /// Called by `handle` when the other thread has something to look at; an empty function takes the
  /// callback back. Must not call back here.
  void on_request(std::function<void()> callback);

  /// Successor: takes note of a message that was received; false when the ones of this port before
  /// it are not needed.
  [[nodiscard]] bool keep(const std::string& port, std::uint64_t sequence_number);
  /// What to begin with.
  struct Begin {
    Positions positions;  ///< a port that is not there begins with whatever comes
    State state;          ///< of the predecessor; empty when it gave none
  };
  /// Successor: nothing until it is to begin.
  [[nodiscard]] std::optional<Begin> begin();

  /// Predecessor: whether it was asked to leave.
  [[nodiscard]] bool asked() const { return asked_.load(std::memory_order_acquire); }
  /// Predecessor: whether that message and those behind it are left to the successor.
  [[nodiscard]] bool leaves(const std::string& port, std::uint64_t sequence_number) const;
  /// Predecessor: everything before these positions has been handled and has arrived, nothing more
  /// will.
  void left(const Positions& next, State state);

 private:
  void hand_over(const msg::ControlRequest& request, msg::ControlReply& reply);

  struct Kept {
    std::uint32_t count = 0;
    std::uint64_t first = 0;
  };
  const std::chrono::milliseconds longest_handover_;
  std::atomic<bool> held_;
  std::atomic<bool> asked_{false};
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::function<void()> callback_;
  bool keeping_ = false;
  std::map<std::string, Kept> kept_;  // by port
  Positions leave_from_;
  std::optional<Begin> begin_;
  std::optional<Positions> next_;
  State state_;
};

}  // namespace quoin::runtime
