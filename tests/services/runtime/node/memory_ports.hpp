// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "services/runtime/node/ports.hpp"

namespace quoin::runtime {

/// What has come for one reader. The test fills it, from any thread.
template <class T>
class MemoryQueue {
 public:
  void push(const T& message) {
    const std::lock_guard lock(mutex_);
    messages_.push_back(std::make_shared<const T>(message));
  }
  [[nodiscard]] std::shared_ptr<const T> pop() {
    const std::lock_guard lock(mutex_);
    if (messages_.empty()) return nullptr;
    auto message = std::move(messages_.front());
    messages_.pop_front();
    std::erase_if(taken_, [](const auto& taken) { return taken.expired(); });
    taken_.push_back(message);
    return message;
  }
  [[nodiscard]] std::size_t size() const {
    const std::lock_guard lock(mutex_);
    return messages_.size();
  }
  /// How many of those that were taken are still kept.
  [[nodiscard]] std::size_t kept() const {
    const std::lock_guard lock(mutex_);
    return static_cast<std::size_t>(std::count_if(
        taken_.begin(), taken_.end(), [](const auto& taken) { return !taken.expired(); }));
  }

  std::size_t writers = 1;
  std::vector<std::string> incompatible;

 private:
  mutable std::mutex mutex_;
  std::deque<std::shared_ptr<const T>> messages_;
  std::vector<std::weak_ptr<const T>> taken_;
};

template <class T>
class MemoryInput final : public Input {
 public:
  explicit MemoryInput(std::shared_ptr<MemoryQueue<T>> queue) : queue_(std::move(queue)) {}

  [[nodiscard]] std::optional<Message> take() override {
    const auto message = queue_->pop();
    if (!message) return std::nullopt;
    return Message{message, &typeid(T), &message->header()};
  }
  [[nodiscard]] std::size_t matched() const override { return queue_->writers; }
  [[nodiscard]] std::vector<std::string> incompatible_qos() const override {
    return queue_->incompatible;
  }

 private:
  std::shared_ptr<MemoryQueue<T>> queue_;
};

/// What a writer gives to: keeps what was written and passes it to the queues of the readers.
template <class T>
struct MemoryTopic {
  std::vector<T> written;
  std::size_t refused = 0;
  std::vector<std::shared_ptr<MemoryQueue<T>>> readers;
  /// Asked at each write whether there is room.
  std::function<bool()> room = [] { return true; };
  /// How often a message that was taken gets to that reader.
  std::function<int(std::size_t reader)> arrivals = [](std::size_t) { return 1; };
  std::vector<std::string> silent;  ///< readers that keep a lossless writer waiting
  std::vector<std::string> incompatible;
  std::size_t liveliness = 0;  ///< how often it was asserted

  [[nodiscard]] std::shared_ptr<MemoryQueue<T>> subscribe() {
    return readers.emplace_back(std::make_shared<MemoryQueue<T>>());
  }
  void publish(const T& message) {
    written.push_back(message);
    for (std::size_t i = 0; i < readers.size(); ++i) {
      for (int copies = arrivals(i); copies > 0; --copies) readers[i]->push(message);
    }
  }
};

template <class T>
class MemoryOutput final : public Output {
 public:
  explicit MemoryOutput(std::shared_ptr<MemoryTopic<T>> topic) : topic_(std::move(topic)) {}

  [[nodiscard]] const std::type_info& type() const override { return typeid(T); }
  [[nodiscard]] void* message() override { return current_; }
  void use(void* message) override { current_ = static_cast<T*>(message); }
  [[nodiscard]] msg::Header& header() override { return current_->header(); }
  [[nodiscard]] bool write() override {
    if (!topic_->room()) {
      ++topic_->refused;
      return false;
    }
    topic_->publish(*current_);
    return true;
  }
  [[nodiscard]] std::size_t matched() const override { return topic_->readers.size(); }
  void assert_liveliness() override { ++topic_->liveliness; }
  [[nodiscard]] std::vector<std::string> check_silent_readers() override { return topic_->silent; }
  [[nodiscard]] std::vector<std::string> incompatible_qos() const override {
    return topic_->incompatible;
  }

 private:
  std::shared_ptr<MemoryTopic<T>> topic_;
  T own_;
  T* current_ = &own_;
};

}  // namespace quoin::runtime
