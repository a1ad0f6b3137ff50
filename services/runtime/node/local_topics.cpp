// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/runtime/node/local_topics.hpp"

#include <algorithm>
#include <utility>

namespace quoin::runtime {

void LocalQueue::push(const Message& message) {
  const std::lock_guard lock(mutex_);
  if (closed_) return;
  if (!limit_.lossless && messages_.size() >= limit_.depth) messages_.pop_front();
  messages_.push_back(message);
  if (on_message_) on_message_();
}

void LocalQueue::close() {
  const std::lock_guard lock(mutex_);
  closed_ = true;
  on_message_ = nullptr;
  messages_.clear();
  taken_.notify_all();
}

std::optional<Message> LocalQueue::pop() {
  const std::lock_guard lock(mutex_);
  if (messages_.empty()) return std::nullopt;
  std::optional<Message> message(std::move(messages_.front()));
  messages_.pop_front();
  // A writer that waits gets room for several messages at once.
  if (limit_.lossless && messages_.size() == limit_.depth / 2) taken_.notify_all();
  return message;
}

bool LocalQueue::empty() const {
  const std::lock_guard lock(mutex_);
  return messages_.empty();
}

bool LocalQueue::has_room() const {
  const std::lock_guard lock(mutex_);
  return !limit_.lossless || messages_.size() < limit_.depth;
}

bool LocalQueue::wait_for_room(std::chrono::milliseconds timeout) {
  if (!limit_.lossless) return true;
  std::unique_lock lock(mutex_);
  if (messages_.size() < limit_.depth) return true;
  taken_.wait_for(lock, timeout, [this] { return messages_.size() <= limit_.depth / 2; });
  return messages_.size() < limit_.depth;
}

std::shared_ptr<LocalQueue> LocalTopic::subscribe(const std::string& reader, QueueLimit limit,
                                                  std::function<void()> on_message) {
  auto queue = std::make_shared<LocalQueue>(reader, limit, std::move(on_message));
  const std::lock_guard lock(mutex_);
  queues_.push_back(queue);
  return queue;
}

void LocalTopic::unsubscribe(const std::shared_ptr<LocalQueue>& queue) {
  {
    const std::lock_guard lock(mutex_);
    std::erase(queues_, queue);
  }
  queue->close();
}

LocalTopic::Queues LocalTopic::queues() const {
  const std::lock_guard lock(mutex_);
  return queues_;
}

std::size_t LocalTopic::readers() const {
  const std::lock_guard lock(mutex_);
  return static_cast<std::size_t>(
      std::ranges::count_if(queues_, [](const auto& queue) { return !queue->by_dds; }));
}

bool LocalTopic::empty() const {
  const std::lock_guard lock(mutex_);
  return queues_.empty();
}

std::vector<std::string> LocalTopic::full_readers() const {
  std::vector<std::string> names;
  for (const auto& queue : queues()) {
    if (!queue->has_room()) names.push_back(queue->reader());
  }
  return names;
}

bool LocalTopic::wait_for_room(std::chrono::milliseconds timeout) {
  const auto deadline = std::chrono::steady_clock::now() + timeout;
  for (const auto& queue : queues()) {
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(
        deadline - std::chrono::steady_clock::now());
    if (!queue->wait_for_room(std::max(left, std::chrono::milliseconds(0)))) return false;
  }
  return true;
}

void LocalTopic::publish(const Message& message) {
  for (const auto& queue : queues()) queue->push(message);
}

std::shared_ptr<LocalTopic> LocalTopics::topic(const std::string& name) {
  const std::lock_guard lock(mutex_);
  std::shared_ptr<LocalTopic>& topic = topics_[name];
  if (!topic) topic = std::make_shared<LocalTopic>();
  return topic;
}

LocalInput::LocalInput(std::shared_ptr<LocalTopic> topic, const std::string& reader,
                       QueueLimit limit, std::function<void()> on_message)
    : topic_(std::move(topic)), queue_(topic_->subscribe(reader, limit, std::move(on_message))) {}

TakeOverInput::TakeOverInput(std::unique_ptr<LocalInput> neighbour, std::unique_ptr<Input> before,
                             std::function<void()> close)
    : neighbour_(std::move(neighbour)), before_(std::move(before)), close_(std::move(close)) {
  neighbour_->set_by_dds(true);
}

std::optional<Message> TakeOverInput::take() {
  const std::lock_guard lock(mutex_);
  if (before_) {
    // The neighbour begins when all that the process before has published has arrived.
    const bool last = !neighbour_->empty();
    while (auto message = before_->take()) {
      const auto& trace = message->header->trace();
      const bool twice = !trace.empty() && trace.back().incarnation() == neighbour_->writer();
      if (!twice) return message;
    }
    if (last) {
      close_();
      before_.reset();
      neighbour_->set_by_dds(false);
    }
  }
  return neighbour_->take();
}

std::size_t TakeOverInput::matched() const {
  const std::lock_guard lock(mutex_);
  return before_ ? before_->matched() : neighbour_->matched();
}

std::vector<std::string> TakeOverInput::incompatible_qos() const {
  const std::lock_guard lock(mutex_);
  return before_ ? before_->incompatible_qos() : std::vector<std::string>();
}

topics::RefusedCounts TakeOverInput::refused() const {
  const std::lock_guard lock(mutex_);
  return before_ ? before_->refused() : topics::RefusedCounts();
}

}  // namespace quoin::runtime
