// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/runtime/node/source.hpp"

#include <exception>
#include <limits>
#include <optional>

#include <spdlog/spdlog.h>

#include "services/runtime/process/clock.hpp"
#include "services/runtime/process/control.hpp"
#include "services/runtime/node/delivery.hpp"
#include "services/runtime/process/service_activity.hpp"
#include "services/topics/header.hpp"

namespace quoin::runtime {

namespace {

class PublishingSource final : public ServiceActivity<Source> {
 public:
  PublishingSource(Service& service, Writer<msg::Scan>& writer, std::uint64_t first)
      : ServiceActivity<Source>(service),
        writer_(writer),
        lossless_(qos_preset(service.config.qos) == QosPreset::lossless),
        next_sequence_(first) {}

  [[nodiscard]] std::uint64_t next_sequence() const { return next_sequence_; }

  bool publish(msg::Scan& scan) override {
    if (service_.stop.requested()) return false;
    msg::Header& header = scan.header();
    topics::set_origin(header, service_.config.name, service_.heartbeat.incarnation(),
                       next_sequence_++);
    header.trace().resize(1);
    msg::StageTrace& trace = header.trace()[0];
    trace.service(service_.config.name);
    trace.incarnation(service_.heartbeat.incarnation());
    trace.index(next_index_);
    trace.received(now_ns());
    const bool delivered =
        deliver(writer_, scan, trace, lossless_, service_.stop, service_.heartbeat.pulse());
    if (delivered) {
      ++next_index_;
      service_.heartbeat.count_published(trace.published(), trace.received(), trace.published(), 0);
    } else {
      service_.heartbeat.count_loss(LossCause::publishing);
    }
    return !service_.stop.requested();
  }

 private:
  Writer<msg::Scan>& writer_;
  bool lossless_;
  std::uint64_t next_sequence_;
  std::uint64_t next_index_ = 0;
};

/// The number of the first scan; nothing when asked to stop before there is one to publish.
std::optional<std::uint64_t> wait_for_begin(Service& service, const WriterBase& writer) {
  if (!service.wait_for_readers(writer)) return std::nullopt;
  if (!service.succession.held()) return 0;
  service.heartbeat.set_state(msg::ServiceState::STATE_HELD);
  while (true) {
    const std::optional<std::uint64_t> first = service.succession.begin();
    if (first) service.heartbeat.set_first_sequence_number(*first);
    if (first) return first;
    const auto soon = std::chrono::steady_clock::now() + std::chrono::milliseconds(2);
    if (!service.stop.wait_until(soon)) return std::nullopt;
  }
}

/// What has been written must reach the readers before the writer goes. They may just be getting to
/// know it when a short source is finished, which nobody wants to end at a certain time.
bool all_is_acknowledged(const Service& service, WriterBase& writer) {
  using std::chrono::steady_clock;
  constexpr std::chrono::milliseconds slice{100};
  constexpr std::chrono::seconds longest_wait_when_finished{10};
  const auto begin = steady_clock::now();
  while (!writer.wait_for_acknowledgments(slice)) {
    const auto limit =
        service.stop.requested() ? longest_wait_for_acknowledgments : longest_wait_when_finished;
    if (steady_clock::now() >= begin + limit) return false;
  }
  return true;
}

int publish_all(Service& service, const std::function<void(Source&)>& body) {
  Writer<msg::Scan> writer(service.participant,
                           output_topic(service.deployment, service.config),
                           output_qos(service.config));
  service.heartbeat.set_endpoint_report([&writer](msg::ServiceStatus& status) {
    status.matched_outputs(static_cast<std::uint32_t>(writer.matched()));
    status.incompatible_qos(writer.incompatible_qos());
  });
  ControlServer control(service, [&](const msg::ControlRequest& request, msg::ControlReply& reply) {
    if (request.action() != msg::ControlAction::CONTROL_DESCRIBE) {
      throw std::invalid_argument("kind " + service.config.kind +
                                  " has no methods; change its parameters in the deployment file "
                                  "and apply that (quoin apply)");
    }
    reply.accepted(true);
  });
  service.succession.on_request([&service] {
    if (service.succession.leaves(std::numeric_limits<std::uint64_t>::max())) {
      service.stop.request();
    }
  });
  int exit_code = exit_ok;
  std::uint64_t next = 0;
  msg::ServiceState state = msg::ServiceState::STATE_STOPPED;
  std::string detail;
  if (const auto first = wait_for_begin(service, writer)) {
    service.heartbeat.set_state(msg::ServiceState::STATE_ACTIVE);
    PublishingSource source(service, writer, *first);
    try {
      body(source);
      if (!service.stop.requested()) state = msg::ServiceState::STATE_FINISHED;
    } catch (const SourceError& error) {
      spdlog::error("{}", error.what());
      state = msg::ServiceState::STATE_FAILED;
      detail = error.what();
      exit_code = exit_input;
    }
    next = source.next_sequence();
  }
  service.heartbeat.stopping();
  if (!all_is_acknowledged(service, writer)) {
    spdlog::warn("not all readers have acknowledged the last scans");
  }
  service.succession.on_request(nullptr);
  service.succession.left(next);
  service.heartbeat.finish(state, detail);
  service.heartbeat.set_endpoint_report(nullptr);
  return exit_code;
}

}  // namespace

int run_source(int argc, char** argv, const std::string& kind, const SourceFactory& open) {
  std::function<void(Source&)> body;
  return run_service(
      argc, argv, kind,
      [&](const Deployment& deployment, const ServiceConfig& config) {
        body = open_body(open, deployment, config);
      },
      [&](Service& service) { return publish_all(service, body); });
}

}  // namespace quoin::runtime
