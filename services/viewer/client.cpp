// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/viewer/client.hpp"

#include <algorithm>
#include <utility>

namespace quoin::viewer {

namespace {

// A client that gets less than it asked for hears of it this often, not with each message.
constexpr std::size_t frames_between_reports = 50;

}  // namespace

Client::Client(std::vector<std::string> topics, std::vector<std::string> services,
               const std::vector<std::string>& greeting, ClientLimits limits)
    : limits_(limits), topics_(std::move(topics)), services_(std::move(services)) {
  for (const std::string& text : greeting) control(text);
}

void Client::control(std::string text, bool is_text) {
  control_.push_back({is_text, std::move(text)});
}

void Client::receive_text(std::string_view text,
                          const std::function<void(std::uint32_t)>& subscribed) {
  const Request request = parse_text(text);
  std::vector<std::uint32_t> added;
  {
    const std::lock_guard lock(mutex_);
    if (const auto* subscribe = std::get_if<Subscribe>(&request)) {
      handle(*subscribe, added);
    } else if (const auto* unsubscribe = std::get_if<Unsubscribe>(&request)) {
      handle(*unsubscribe);
    } else if (const auto* other = std::get_if<NotOffered>(&request)) {
      control(status(StatusLevel::warning, "'" + other->operation + "' is not offered here"));
    }
  }
  for (const std::uint32_t channel : added) subscribed(channel);
}

void Client::handle(const Subscribe& request, std::vector<std::uint32_t>& added) {
  for (const Subscription& wanted : request.subscriptions) {
    const auto complain = [&](const std::string& why) {
      control(status(StatusLevel::error, "subscription " + std::to_string(wanted.id) + ": " + why));
    };
    if (wanted.channel == 0 || wanted.channel > topics_.size()) {
      complain("there is no channel " + std::to_string(wanted.channel));
    } else if (subscriptions_.contains(wanted.channel)) {
      complain("channel " + std::to_string(wanted.channel) + " has been subscribed to before");
    } else if (subscriptions_.size() >= limits_.subscriptions) {
      complain("no more than " + std::to_string(limits_.subscriptions) + " subscriptions");
    } else {
      subscriptions_.emplace(wanted.channel, wanted.id);
      added.push_back(wanted.channel);
    }
    if (control_.size() > limits_.control_frames) return;
  }
}

void Client::handle(const Unsubscribe& request) {
  for (const std::uint32_t id : request.subscriptions) {
    std::erase_if(subscriptions_, [&](const auto& each) { return each.second == id; });
  }
}

void Client::receive_binary(std::string_view bytes, const Service& call) {
  const Request request = parse_binary(bytes);
  std::string answer;
  bool failed = true;
  if (const auto* wanted = std::get_if<ServiceCall>(&request)) {
    const auto refuse = [&](const std::string& why) {
      answer = service_failure(wanted->service, wanted->call, why);
    };
    if (wanted->service == 0 || wanted->service > services_.size()) {
      refuse("there is no service " + std::to_string(wanted->service));
    } else if (wanted->encoding != "json") {
      refuse("services take JSON");
    } else {
      try {
        answer = service_response(wanted->service, wanted->call,
                                  call(services_[wanted->service - 1], wanted->request));
        failed = false;
      } catch (const std::exception& error) {
        refuse(error.what());
      }
    }
  } else if (const auto* other = std::get_if<NotOffered>(&request)) {
    answer = status(StatusLevel::warning, "'" + other->operation + "' is not offered here");
  }
  const std::lock_guard lock(mutex_);
  control(std::move(answer), failed);
}

void Client::advertise(const Channel& channel) {
  const std::lock_guard lock(mutex_);
  topics_.push_back(channel.topic);
  control(advertisement({&channel, 1}));
}

bool Client::offer(std::uint32_t channel, const Payload& payload) {
  const std::lock_guard lock(mutex_);
  const auto subscription = subscriptions_.find(channel);
  if (subscription == subscriptions_.end()) return false;
  Frame frame{false, message_head(subscription->second, payload.time), payload};
  const std::size_t size = frame.size();
  const bool idle = messages_.empty() && control_.empty();
  make_room(channel, size);
  if (queued_bytes_ + size > limits_.queued_bytes) {  // it alone is too large
    ++unreported_[channel];
    ++dropped_;
  } else {
    queued_bytes_ += size;
    messages_.push_back({channel, std::move(frame)});
  }
  return idle;
}

bool Client::wants(std::uint32_t channel) const {
  const std::lock_guard lock(mutex_);
  return subscriptions_.contains(channel);
}

/// Drops the oldest of the channel, and when there is none left, the oldest of all.
void Client::make_room(std::uint32_t channel, std::size_t size) {
  while (queued_bytes_ + size > limits_.queued_bytes && !messages_.empty()) {
    const auto same = std::ranges::find(messages_, channel, &Queued::channel);
    erase(same == messages_.end() ? messages_.begin() : same);
  }
}

void Client::erase(const std::deque<Queued>::iterator& queued) {
  queued_bytes_ -= queued->frame.size();
  ++unreported_[queued->channel];
  ++dropped_;
  messages_.erase(queued);
}

void Client::report_drops() {
  std::string text;
  for (const auto& [channel, count] : unreported_) {
    text += (text.empty() ? "" : ", ") + std::to_string(count) + " of " + topics_[channel - 1];
  }
  unreported_.clear();
  control(status(StatusLevel::warning, "dropped, because this client is too slow: " + text));
}

std::optional<Frame> Client::next() {
  const std::lock_guard lock(mutex_);
  if (!unreported_.empty() && (until_report_ == 0 || messages_.empty())) {
    report_drops();
    until_report_ = frames_between_reports;
  }
  if (until_report_ > 0) --until_report_;
  if (!control_.empty()) {
    Frame frame = std::move(control_.front());
    control_.pop_front();
    return frame;
  }
  if (messages_.empty()) return std::nullopt;
  Frame frame = std::move(messages_.front().frame);
  messages_.pop_front();
  queued_bytes_ -= frame.size();
  return frame;
}

bool Client::flooded() const {
  const std::lock_guard lock(mutex_);
  return control_.size() > limits_.control_frames;
}

std::uint64_t Client::dropped() const {
  const std::lock_guard lock(mutex_);
  return dropped_;
}

std::size_t Client::queued_bytes() const {
  const std::lock_guard lock(mutex_);
  return queued_bytes_;
}

}  // namespace quoin::viewer
