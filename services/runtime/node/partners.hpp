// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>

#include "services/runtime/node/ports.hpp"

namespace quoin::runtime {

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

 private:
  std::deque<Message> messages_;
};

}  // namespace quoin::runtime
