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

void ControlServer::run() {
  msg::ControlRequest request;
  while (!ending_) {
    wait_set_.wait(std::chrono::seconds(1));
    while (!ending_ && reader_.take(request)) {
      const bool addressed = request.service() == label(service_.config);
      if (!addressed && request.service() != service_.config.name) continue;
      msg::ControlReply reply;
      reply.service(request.service());
      reply.requester(request.requester());
      reply.request(request.request());
      try {
        if (!addressed) {
          throw std::invalid_argument("it has several instances; name one, such as " +
                                      label(service_.config));
        }
        handler_(request, reply);
      } catch (const std::exception& error) {
        reply.accepted(false);
        reply.detail(error.what());
      }
      spdlog::info("control request {} of '{}' {}{}{}", request.request(), request.requester(),
                   reply.accepted() ? "done" : "refused", reply.detail().empty() ? "" : ": ",
                   reply.detail());
      writer_.write(reply);
    }
  }
}

}  // namespace quoin::runtime
