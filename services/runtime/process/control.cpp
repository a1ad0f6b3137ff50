// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/runtime/process/control.hpp"

#include <algorithm>
#include <exception>

#include <spdlog/spdlog.h>

namespace quoin::runtime {

namespace {

constexpr std::size_t most_waiting = 16;
constexpr int most_accepted_a_second = 400;  // more than anybody can ask one after the other
constexpr int most_refusals_a_second = 50;
constexpr std::size_t longest_text = 4096;  // a path is the longest that a request may carry
constexpr std::size_t most_parameters = 64;
constexpr std::size_t most_positions = 64;
constexpr std::size_t largest_state = 64U << 20U;  // [byte]

bool oversized(const msg::ControlRequest& request) {
  return request.requester().size() > longest_text || request.method().size() > longest_text ||
         request.file().size() > longest_text || request.parameters().size() > most_parameters ||
         request.positions().size() > most_positions || request.state().size() > largest_state ||
         std::any_of(request.parameters().begin(), request.parameters().end(),
                     [](const msg::ParameterSetting& setting) {
                       return setting.name().size() > longest_text ||
                              setting.value().size() > longest_text;
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

ControlServer::ControlServer(Service& service, Succession& succession, Handler handler)
    : service_(service),
      succession_(succession),
      handler_(std::move(handler)),
      writer_(service.participant, control_reply_topic(service.deployment.name_space),
              QosPreset::control),
      reader_(service.participant, control_request_topic(service.deployment.name_space),
              QosPreset::control) {
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
  // The answer to a request that ended the process must not go with it.
  writer_.wait_for_acknowledgments(std::chrono::milliseconds(500));
}

// Two processes have the same name while one takes over from the other.
bool ControlServer::for_this_process(const msg::ControlRequest& request) const {
  return request.incarnation() == 0 ? !succession_.held()
                                    : request.incarnation() == service_.record.incarnation();
}

void ControlServer::receive() {
  msg::ControlRequest request;
  while (!ending_) {
    wait_set_.wait(std::chrono::seconds(1));
    while (!ending_ && reader_.take(request)) {
      if (!for_this_process(request)) continue;
      if (request.service() == label(service_.config)) {
        accept(request);
      } else if (request.service() == service_.config.name) {
        refuse(request, "it has several instances; name one, such as " + label(service_.config));
      }
    }
  }
}

void ControlServer::accept(const msg::ControlRequest& request) {
  if (oversized(request)) {
    refuse(request, "larger than any request of use; nothing was read of it");
    return;
  }
  begin_second();
  if (accepted_ >= most_accepted_a_second) {
    refuse(request, "more than " + std::to_string(most_accepted_a_second) + " requests a second");
    return;
  }
  {
    const std::lock_guard lock(mutex_);
    if (waiting_.size() < most_waiting) {
      ++accepted_;
      waiting_.push_back(request);
      changed_.notify_all();
      return;
    }
  }
  refuse(request,
         "already " + std::to_string(most_waiting) + " requests are waiting; ask again later");
}

void ControlServer::begin_second() {
  const auto now = Clock::now();
  if (now - second_ < std::chrono::seconds(1)) return;
  second_ = now;
  accepted_ = 0;
  refusals_ = 0;
}

void ControlServer::refuse(const msg::ControlRequest& request, const std::string& why) {
  begin_second();
  if (++refusals_ > most_refusals_a_second) {
    service_.record.count_control_drop();
    return;
  }
  if (refusals_ == 1) spdlog::warn("control requests refused: {}", why);
  msg::ControlReply reply = reply_to(request);
  if (reply.requester().size() > longest_text) reply.requester().resize(longest_text);
  reply.accepted(false);
  reply.detail(why);
  answer(reply);
}

void ControlServer::work() {
  std::unique_lock lock(mutex_);
  while (true) {
    changed_.wait(lock, [this] { return ending_ || !waiting_.empty(); });
    if (ending_) return;
    const msg::ControlRequest request = std::move(waiting_.front());
    waiting_.pop_front();
    lock.unlock();
    handle(request);
    lock.lock();
  }
}

void ControlServer::handle(const msg::ControlRequest& request) {
  msg::ControlReply reply = reply_to(request);
  try {
    carry_out(request, reply);
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

void ControlServer::carry_out(const msg::ControlRequest& request, msg::ControlReply& reply) {
  if (succession_.handle(request, reply)) {
    reply.accepted(true);
  } else if (request.action() == msg::ControlAction::CONTROL_STOP) {
    service_.stop.request();
    reply.accepted(true);
  } else {
    handler_(request, reply);
  }
}

void ControlServer::answer(const msg::ControlReply& reply) {
  const std::lock_guard lock(write_mutex_);
  writer_.write(reply);
}

}  // namespace quoin::runtime
