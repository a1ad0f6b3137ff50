// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "services/runtime/node/ports.hpp"

namespace quoin::runtime {

/// How far a reader may be behind its writer, and what happens then.
struct QueueLimit {
  std::size_t depth = 32;
  bool lossless = false;  ///< the writer waits; otherwise the oldest message is dropped
};

/// Messages of one reader of a LocalTopic that have not been taken yet.
class LocalQueue {
 public:
  LocalQueue(std::string reader, QueueLimit limit, std::function<void()> on_message)
      : reader_(std::move(reader)), limit_(limit), on_message_(std::move(on_message)) {}

  [[nodiscard]] const std::string& reader() const { return reader_; }
  void push(const Message& message);
  [[nodiscard]] std::optional<Message> pop();
  [[nodiscard]] bool empty() const;
  [[nodiscard]] bool has_room() const;
  /// False when there is none after `timeout`. Always there where the reader is not lossless.
  bool wait_for_room(std::chrono::milliseconds timeout);
  /// The reader goes: it is not called back any more, and nobody waits for it.
  void close();
  /// The reader hears the writer by DDS, too, and is counted there.
  std::atomic<bool> by_dds{false};

 private:
  const std::string reader_;
  const QueueLimit limit_;
  mutable std::mutex mutex_;
  std::function<void()> on_message_;
  std::condition_variable taken_;
  std::deque<Message> messages_;
  bool closed_ = false;
};

/// A topic between nodes of one process: a message is handed over as it is, to be read only. Any
/// thread may call any function; one writer at a time.
class LocalTopic {
 public:
  /// `on_message` is called by the writer's thread after each message; must not call back here.
  [[nodiscard]] std::shared_ptr<LocalQueue> subscribe(const std::string& reader, QueueLimit limit,
                                                      std::function<void()> on_message);
  void unsubscribe(const std::shared_ptr<LocalQueue>& queue);

  /// `incarnation` of the writer's service.
  void open(std::uint64_t incarnation) { writer_ = incarnation; }
  void close() { writer_ = 0; }
  /// Of the writer that is there; 0 when there is none.
  [[nodiscard]] std::uint64_t writer() const { return writer_; }

  /// Readers that hear the writer here alone.
  [[nodiscard]] std::size_t readers() const;
  [[nodiscard]] bool empty() const;
  /// Names of lossless readers without room.
  [[nodiscard]] std::vector<std::string> full_readers() const;
  /// False when a lossless reader has none after `timeout`.
  bool wait_for_room(std::chrono::milliseconds timeout);
  void publish(const Message& message);

 private:
  using Queues = std::vector<std::shared_ptr<LocalQueue>>;
  [[nodiscard]] Queues queues() const;

  std::atomic<std::uint64_t> writer_{0};
  mutable std::mutex mutex_;
  Queues queues_;
};

/// The topics of a process by their names.
class LocalTopics {
 public:
  /// Makes it when it is not there.
  [[nodiscard]] std::shared_ptr<LocalTopic> topic(const std::string& name);

 private:
  std::mutex mutex_;
  std::map<std::string, std::shared_ptr<LocalTopic>> topics_;
};

/// Messages of a node in the same process.
class LocalInput final : public Input {
 public:
  LocalInput(std::shared_ptr<LocalTopic> topic, const std::string& reader, QueueLimit limit,
             std::function<void()> on_message);
  ~LocalInput() override { topic_->unsubscribe(queue_); }
  LocalInput(const LocalInput&) = delete;
  LocalInput& operator=(const LocalInput&) = delete;

  [[nodiscard]] std::optional<Message> take() override { return queue_->pop(); }
  [[nodiscard]] std::size_t matched() const override { return topic_->writer() == 0 ? 0 : 1; }
  [[nodiscard]] bool empty() const { return queue_->empty(); }
  [[nodiscard]] std::uint64_t writer() const { return topic_->writer(); }
  void set_by_dds(bool by_dds) { queue_->by_dds = by_dds; }

 private:
  std::shared_ptr<LocalTopic> topic_;
  std::shared_ptr<LocalQueue> queue_;
};

/// Of a node that takes over together with its neighbour in the process: what the process before
/// publishes comes by DDS, until the neighbour does the work.
class TakeOverInput final : public Input {
 public:
  /// `close`: called once before `before` is destroyed.
  TakeOverInput(std::unique_ptr<LocalInput> neighbour, std::unique_ptr<Input> before,
                std::function<void()> close);

  [[nodiscard]] std::optional<Message> take() override;
  [[nodiscard]] std::size_t matched() const override;
  [[nodiscard]] std::vector<std::string> incompatible_qos() const override;
  [[nodiscard]] topics::RefusedCounts refused() const override;

 private:
  std::unique_ptr<LocalInput> neighbour_;
  mutable std::mutex mutex_;       // the heartbeat asks for what is matched
  std::unique_ptr<Input> before_;  // until it is not needed any more
  std::function<void()> close_;
};

}  // namespace quoin::runtime
