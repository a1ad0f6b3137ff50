// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/runtime/control.hpp"

#include <exception>

#include <spdlog/spdlog.h>

namespace quoin::runtime {

ControlServer::ControlServer(Service& service, Handler handler)
    : service_(service),
      handler_(std::move(handler)),
      writer_(service.participant, deploy::control_reply_topic(service.deployment.name_space),
              QosPreset::control),
      reader_(service.participant, deploy::control_request_topic(service.deployment.name_space),
              QosPreset::control) {
  wait_set_.add(reader_);
  thread_ = std::thread([this] { run(); });
}

ControlServer::~ControlServer() {
  ending_ = true;
  wait_set_.wake();
  thread_.join();
}

// Two processes have the same name while one takes over from the other.
bool ControlServer::addressed(const msg::ControlRequest& request) const {
  if (request.service() != service_.config.name) return false;
  return request.incarnation() == 0 ? !service_.succession.held()
                                    : request.incarnation() == service_.heartbeat.incarnation();
}

void ControlServer::answer(const msg::ControlRequest& request, msg::ControlReply& reply) {
  if (service_.succession.handle(request, reply)) {
    reply.accepted(true);
  } else if (request.action() == msg::ControlAction::CONTROL_STOP) {
    service_.stop.request();
    reply.accepted(true);
  } else {
    handler_(request, reply);
  }
}

void ControlServer::run() {
  msg::ControlRequest request;
  while (!ending_) {
    wait_set_.wait(std::chrono::seconds(1));
    while (!ending_ && reader_.take(request)) {
      if (!addressed(request)) continue;
      msg::ControlReply reply;
      reply.service(request.service());
      reply.requester(request.requester());
      reply.request(request.request());
      try {
        answer(request, reply);
      } catch (const std::exception& error) {
        reply.accepted(false);
        reply.detail(error.what());
      }
      if (request.action() != msg::ControlAction::CONTROL_DESCRIBE) {
        spdlog::info("control request {} of '{}' {}{}{}", request.request(), request.requester(),
                     reply.accepted() ? "done" : "refused", reply.detail().empty() ? "" : ": ",
                     reply.detail());
      }
      writer_.write(reply);
    }
  }
  // The answer to a request that ended the process must not go with it.
  writer_.wait_for_acknowledgments(std::chrono::milliseconds(500));
}

}  // namespace quoin::runtime
