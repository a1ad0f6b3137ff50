// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <idl/Common.h>
#include <memory>
#include <optional>
#include <string>
#include <typeinfo>
#include <vector>

#include "services/runtime/node/service_record.hpp"
#include "services/topics/message_check.hpp"

namespace quoin::runtime {

/// A message that came by an input, shared by all who look at it. The node may keep it for a while.
struct Message {
  std::shared_ptr<const void> data;
  const std::type_info* type = nullptr;
  const msg::Header* header = nullptr;  ///< inside data

  template <class T>
  [[nodiscard]] const T* as() const {
    return *type == typeid(T) ? static_cast<const T*>(data.get()) : nullptr;
  }
};

/// Where the messages of one port come from: DDS, or memory in a test.
class Input {
 public:
  virtual ~Input() = default;
  /// The next message; nothing when there is none yet.
  [[nodiscard]] virtual std::optional<Message> take() = 0;
  /// Writers matched now.
  [[nodiscard]] virtual std::size_t matched() const = 0;
  /// Writers that do not fit, with both sides' values.
  [[nodiscard]] virtual std::vector<std::string> incompatible_qos() const { return {}; }
  /// Messages that came and were not given to anybody, by reason.
  [[nodiscard]] virtual topics::RefusedCounts refused() const { return {}; }
};

/// Where the messages of one topic go to.
class Output {
 public:
  virtual ~Output() = default;
  [[nodiscard]] virtual const std::type_info& type() const = 0;
  /// The message to fill, of that type. It keeps its memory from one to the next.
  [[nodiscard]] virtual void* message() = 0;
  /// From now on that is somebody else's message of that type, which outlives the writing.
  virtual void use(void* message) = 0;
  [[nodiscard]] virtual msg::Header& header() = 0;
  /// Writes that message. False when it was not taken.
  [[nodiscard]] virtual bool write() = 0;

  /// Readers matched now.
  [[nodiscard]] virtual std::size_t matched() const = 0;
  /// Observers that have announced themselves and are not matched yet.
  [[nodiscard]] virtual std::vector<std::string> awaited_observers() const { return {}; }
  /// True once all readers have everything; false after `timeout`.
  virtual bool wait_for_acknowledgments(std::chrono::milliseconds) { return true; }
  /// Asserts the liveliness of this writer when it has nothing to write.
  virtual void assert_liveliness() {}
  /// Readers that keep a lossless writer waiting and were not heard for long; those that are dead
  /// are dropped.
  [[nodiscard]] virtual std::vector<std::string> check_silent_readers() { return {}; }
  [[nodiscard]] virtual std::vector<std::string> incompatible_qos() const { return {}; }
};

/// The messages of a `latest` or `by_time` port that may still be wanted, in the order of their
/// stamps, in whatever order they came.
class Partners {
 public:
  /// Older ones of the same stamp give way.
  void add(Message message);

  /// The newest; null when there is none.
  [[nodiscard]] const Message* latest() const;
  /// The newest that is not younger than `stamp` [ns]; null when there is none.
  [[nodiscard]] const Message* before(std::int64_t stamp) const;
  /// The oldest that is not older; null when there is none.
  [[nodiscard]] const Message* after(std::int64_t stamp) const;
  /// What is asked for from now on is not older than that.
  void forget_before(std::int64_t stamp);
  /// Only the newest will be asked for.
  void keep_latest();
  [[nodiscard]] std::size_t size() const { return messages_.size(); }
  /// In the order of their stamps.
  [[nodiscard]] const std::deque<Message>& messages() const { return messages_; }

 private:
  std::deque<Message> messages_;
};

/// How long the end of a service may wait: for room in a full history once the stop is requested,
/// and for the last results to be acknowledged. With a write that was under way and the last
/// heartbeat it is less than the five seconds after which `quoin up` kills.
inline constexpr std::chrono::seconds longest_wait_for_room{1};
inline constexpr std::chrono::seconds longest_wait_for_acknowledgments{2};

/// What the thread that data passes through works with.
struct DataThread {
  ServiceRecord& record;
  Pulse& pulse;                    ///< alive while it waits for readers
  std::function<bool()> stopping;  ///< whether the service was asked to stop
  /// The clock by which is waited.
  std::function<std::chrono::steady_clock::time_point()> now = std::chrono::steady_clock::now;
};

/// Stamps `trace` (which is part of the output's message) and writes the message. With the lossless
/// preset the write is tried again while slow readers keep the history full, until
/// longest_wait_for_room after the stop is requested; readers that are dead are dropped meanwhile,
/// and the record says who keeps it waiting. Otherwise it never waits. False when the message was
/// not written.
[[nodiscard]] bool deliver(Output& output, msg::StageTrace& trace, bool lossless,
                           DataThread& thread);

}  // namespace quoin::runtime
