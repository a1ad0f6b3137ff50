// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstddef>
#include <idl/Common.h>
#include <memory>
#include <optional>
#include <string>
#include <typeinfo>
#include <vector>

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
  /// Tells that this writer lives though it has nothing to write.
  virtual void assert_liveliness() {}
  /// Readers that keep a lossless writer waiting and were not heard for long; those that are dead
  /// are dropped.
  [[nodiscard]] virtual std::vector<std::string> check_silent_readers() { return {}; }
  [[nodiscard]] virtual std::vector<std::string> incompatible_qos() const { return {}; }
};

}  // namespace quoin::runtime
