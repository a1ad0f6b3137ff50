// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <idl/Control.h>
#include <mutex>
#include <optional>

namespace quoin::runtime {

/// How the work of a service goes from one process to the next without a scan lost or doubled.
///
/// The successor is started held: it reads but does not publish. Asked to hold, it keeps the newest
/// scan and all that follow. Then the predecessor is asked to hand over: it handles the scans
/// before the ones kept, makes sure that its results have arrived, and names the first scan that it
/// leaves. From that one on the successor publishes.
class Succession {
 public:
  explicit Succession(bool held) : held_(held) {}

  /// Whether this process waits to take over.
  [[nodiscard]] bool held() const { return held_.load(std::memory_order_acquire); }

  /// Answers the three requests of a succession, from the control thread; false for any other.
  /// Throws std::runtime_error when the request cannot be granted.
  bool handle(const msg::ControlRequest& request, msg::ControlReply& reply);
  /// Called by `handle` when the other thread has something to look at; an empty function takes the
  /// callback back. Must not call back here.
  void on_request(std::function<void()> callback);

  /// Successor: takes note of a scan that was received; false when the ones before it are not
  /// needed.
  [[nodiscard]] bool keep(std::uint64_t sequence_number);
  /// Successor: the first scan to handle, once it is to begin.
  [[nodiscard]] std::optional<std::uint64_t> begin();

  /// Predecessor: whether scan `sequence_number` and those behind it are left to the successor.
  [[nodiscard]] bool leaves(std::uint64_t sequence_number) const {
    return asked_.load(std::memory_order_acquire) && sequence_number >= leave_from_;
  }
  /// Predecessor: everything before `next` has been handled and has arrived, nothing more will.
  void left(std::uint64_t next);

 private:
  void hand_over(std::uint64_t from, msg::ControlReply& reply);

  std::atomic<bool> held_;
  std::atomic<bool> asked_{false};
  std::atomic<std::uint64_t> leave_from_{0};
  std::mutex mutex_;
  std::condition_variable changed_;
  std::function<void()> callback_;
  bool keeping_ = false;
  std::uint32_t kept_ = 0;
  std::uint64_t first_kept_ = 0;
  std::optional<std::uint64_t> begin_;
  std::optional<std::uint64_t> next_;
};

}  // namespace quoin::runtime
