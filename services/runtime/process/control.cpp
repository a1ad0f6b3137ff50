// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/runtime/process/control.hpp"

#include <algorithm>
#include <exception>

#include <spdlog/spdlog.h>

#include "services/deployment/deployment.hpp"
#include "services/runtime/process/log.hpp"

namespace quoin::runtime {

namespace {

constexpr std::size_t most_requests = 16;
constexpr int most_accepted_a_second = 400;  // more than anybody can ask one after the other
constexpr int most_refusals_a_second = 50;
constexpr std::size_t longest_request_text =
    4096;  // a path is the longest that a request may carry
constexpr std::size_t most_parameters = 64;
constexpr std::size_t most_positions = 4096;  // an observer has one for each type of each service
constexpr std::size_t largest_state = 64U << 20U;  // [byte]

bool oversized(const msg::ControlRequest& request) {
  return request.requester().size() > longest_request_text ||
         request.method().size() > longest_request_text ||
         request.file().size() > longest_request_text ||
         request.parameters().size() > most_parameters ||
         request.positions().size() > most_positions || request.state().size() > largest_state ||
         std::any_of(request.parameters().begin(), request.parameters().end(),
                     [](const msg::ParameterSetting& setting) {
                       return setting.name().size() > longest_request_text ||
                              setting.value().size() > longest_request_text;
                     });
}

msg::ControlReply reply_to(const msg::ControlRequest& request) {
  msg::ControlReply reply;
  reply.service(request.service());
  reply.requester(request.requester());
  reply.request(request.request());
  return reply;
}

}  // namespace

ControlServer::ControlServer(Participant& participant, std::string_view name_space)
    : writer_(participant, control_reply_topic(name_space), QosPreset::control),
      reader_(participant, control_request_topic(name_space), QosPreset::control) {
  wait_set_.add(reader_);
  receiver_ = std::thread([this] { receive(); });
  worker_ = std::thread([this] { work(); });
}

ControlServer::~ControlServer() {
  {
    const std::lock_guard lock(mutex_);
    ending_ = true;
    changed_.notify_all();
  }
  wait_set_.wake();
  receiver_.join();
  worker_.join();
}

void ControlServer::add(ControlTarget target) {
  const std::lock_guard lock(mutex_);
  targets_.push_back(std::make_shared<const ControlTarget>(std::move(target)));
}

void ControlServer::remove(const std::string& label) {
  {
    std::unique_lock lock(mutex_);
    const auto is_meant = [&](const Target& target) { return target->label == label; };
    std::erase_if(targets_, is_meant);
    std::erase_if(waiting_, [&](const Waiting& waiting) { return is_meant(waiting.target); });
    changed_.wait(lock, [&] { return !at_work_ || !is_meant(at_work_); });
  }
  // The answer to a request that ended the service must not go with it.
  writer_.wait_for_acknowledgments(std::chrono::milliseconds(500));
}

namespace {

/// Two processes have services of the same name while one takes over from the other.
bool is_addressed(const ControlTarget& target, const msg::ControlRequest& request) {
  return request.incarnation() == 0 ? !target.succession->held()
                                    : request.incarnation() == target.record->incarnation();
}

}  // namespace

void ControlServer::receive() {
  msg::ControlRequest request;
  while (!ending_) {
    wait_set_.wait(std::chrono::seconds(1));
    while (!ending_ && reader_.take(request)) {
      std::unique_lock lock(mutex_);
      const std::vector<Target> targets = targets_;
      lock.unlock();
      for (const Target& target : targets) {
        if (!is_addressed(*target, request)) continue;
        if (request.service() == target->label) {
          accept(target, request);
        } else if (request.service() == target->name) {
          refuse(*target, request, "it has several instances; name one, such as " + target->label);
        }
      }
    }
  }
}

void ControlServer::accept(const Target& target, const msg::ControlRequest& request) {
  if (oversized(request)) {
    refuse(*target, request, "larger than any request of use; nothing was read of it");
    return;
  }
  begin_second();
  if (accepted_ >= most_accepted_a_second) {
    refuse(*target, request,
           "more than " + std::to_string(most_accepted_a_second) + " requests a second");
    return;
  }
  {
    const std::lock_guard lock(mutex_);
    if (waiting_.size() < most_requests) {
      ++accepted_;
      // Its service may have ended since.
      if (std::ranges::find(targets_, target) != targets_.end()) {
        waiting_.push_back({target, request});
      }
      changed_.notify_all();
      return;
    }
  }
  refuse(*target, request,
         "already " + std::to_string(most_requests) + " requests are waiting; ask again later");
}

void ControlServer::begin_second() {
  const auto now = Clock::now();
  if (now - second_ < std::chrono::seconds(1)) return;
  second_ = now;
  accepted_ = 0;
  refusals_ = 0;
}

void ControlServer::refuse(const ControlTarget& target, const msg::ControlRequest& request,
                           const std::string& why) {
  begin_second();
  if (++refusals_ > most_refusals_a_second) {
    target.record->count_control_drop();
    return;
  }
  if (refusals_ == 1) spdlog::warn("control requests refused: {}", why);
  msg::ControlReply reply = reply_to(request);
  if (reply.requester().size() > longest_request_text)
    reply.requester().resize(longest_request_text);
  reply.accepted(false);
  reply.detail(why);
  answer(reply);
}

void ControlServer::work() {
  std::unique_lock lock(mutex_);
  while (true) {
    changed_.wait(lock, [this] { return ending_ || !waiting_.empty(); });
    if (ending_) return;
    const Waiting next = std::move(waiting_.front());
    waiting_.pop_front();
    at_work_ = next.target;
    lock.unlock();
    handle(*next.target, next.request);
    lock.lock();
    at_work_ = nullptr;
    changed_.notify_all();
  }
}

void ControlServer::handle(const ControlTarget& target, const msg::ControlRequest& request) {
  const LogName log_name(target.label);
  msg::ControlReply reply = reply_to(request);
  try {
    if (target.succession->handle(request, reply)) {
      reply.accepted(true);
    } else if (request.action() == msg::ControlAction::CONTROL_STOP) {
      target.stop->request();
      reply.accepted(true);
    } else {
      target.handler(request, reply);
    }
  } catch (const std::exception& error) {
    reply.accepted(false);
    reply.detail(error.what());
  }
  const bool question = request.action() == msg::ControlAction::CONTROL_DESCRIBE;
  spdlog::log(question ? spdlog::level::debug : spdlog::level::info,
              "control request {} of '{}' {}{}{}", request.request(), request.requester(),
              reply.accepted() ? "done" : "refused", reply.detail().empty() ? "" : ": ",
              reply.detail());
  answer(reply);
}

void ControlServer::answer(const msg::ControlReply& reply) {
  const std::lock_guard lock(write_mutex_);
  writer_.write(reply);
}

}  // namespace quoin::runtime
