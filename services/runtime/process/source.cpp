// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/runtime/process/source.hpp"

#include <exception>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <utility>

#include <spdlog/spdlog.h>

#include "services/deployment/deployment.hpp"
#include "services/runtime/node/clock.hpp"
#include "services/runtime/node/node.hpp"
#include "services/runtime/process/service_activity.hpp"
#include "services/topics/header.hpp"

namespace quoin::runtime {

namespace {

using Outputs = std::vector<Node::OutputPart>;

/// What a source answers to requests for its settings.
class SourceSettings {
 public:
  void set(const Source::Settings& settings) {
    const std::lock_guard lock(mutex_);
    settings_ = settings;
  }

  void answer(const ServiceConfig& config, const msg::ControlRequest& request,
              msg::ControlReply& reply) const {
    std::unique_lock lock(mutex_);
    const Source::Settings settings = settings_;
    lock.unlock();
    const bool question = request.action() == msg::ControlAction::CONTROL_DESCRIBE;
    const bool setting = request.action() == msg::ControlAction::CONTROL_SET_PARAMETERS;
    if (!question && !(setting && settings)) {
      throw std::invalid_argument("kind " + config.kind +
                                  " has no methods; change its parameters in the deployment file "
                                  "and apply that (quoin apply)");
    }
    reply.accepted(true);
    if (!settings) return;
    ParameterSettings asked;
    for (const msg::ParameterSetting& parameter : request.parameters()) {
      asked.push_back({parameter.name(), parameter.value()});
    }
    for (const ParameterSetting& in_force : settings(asked)) {
      msg::ParameterSetting& parameter = reply.parameters().emplace_back();
      parameter.name(in_force.name);
      parameter.value(in_force.text);
    }
  }

 private:
  mutable std::mutex mutex_;
  Source::Settings settings_;
};

class PublishingSource final : public ServiceActivity<Source> {
 public:
  PublishingSource(Service& service, Outputs& outputs, const Positions& first,
                   SourceSettings& settings)
      : ServiceActivity<Source>(service),
        settings_(settings),
        thread_(service.data_thread()),
        outputs_(outputs),
        next_index_(outputs.size(), 0),
        next_number_(outputs.size(), 0) {
    for (std::size_t i = 0; i < outputs.size(); ++i) {
      const auto position = first.find(key(i));
      if (position != first.end()) next_number_[i] = position->second;
    }
  }

  /// Where a successor begins.
  [[nodiscard]] Positions next() const {
    Positions next;
    for (std::size_t i = 0; i < outputs_.size(); ++i) next[key(i)] = next_number_[i];
    return next;
  }

  bool publish(msg::Scan& scan) override { return publish_on(0, &scan, scan.header()); }

  [[nodiscard]] std::size_t readers() const override { return outputs_.front().output->matched(); }

  bool answer_settings(const Settings& settings) override {
    settings_.set(settings);
    return true;
  }

  [[nodiscard]] Participant& participant() override { return service_.process.participant; }

 protected:
  bool publish_own(const std::type_info& type, void* message, msg::Header& header) override {
    for (std::size_t i = 0; i < outputs_.size(); ++i) {
      if (outputs_[i].output->type() != type) continue;
      return publish_on(i, message, header);
    }
    throw std::logic_error("no output of that message type");
  }

 private:
  [[nodiscard]] std::string key(std::size_t output) const {
    return output == 0 ? "" : output_key(outputs_[output].port.type);
  }

  /// False when asked to stop. What comes by the first output counts for the service.
  bool publish_on(std::size_t index, void* message, msg::Header& header) {
    if (service_.stop.requested()) return false;
    const std::int64_t taken = now_ns();
    const std::int64_t published = write(index, message, header, next_number_[index]++, taken);
    if (index == 0 && published > 0) {
      service_.record.count_result(published, taken, published, 0);
    } else if (index == 0) {
      service_.record.count_loss(LossCause::publishing);
    }
    return !service_.stop.requested();
  }

  /// The time of its publication [ns]; 0 when it was not taken.
  std::int64_t write(std::size_t index, void* message, msg::Header& header,
                     std::uint64_t sequence_number, std::int64_t taken) {
    Node::OutputPart& part = outputs_[index];
    topics::set_origin(header, service_.config.name, service_.record.incarnation(),
                       sequence_number);
    header.trace().resize(1);
    msg::StageTrace& trace = header.trace().front();
    trace.service(service_.config.name);
    trace.incarnation(service_.record.incarnation());
    trace.index(next_index_[index]);
    trace.received(taken);
    part.output->use(message);
    const bool written = deliver(*part.output, trace, part.lossless, thread_);
    service_.record.count_output(index, written);
    if (!written) return 0;
    ++next_index_[index];
    return trace.published();
  }

  SourceSettings& settings_;
  DataThread thread_;
  Outputs& outputs_;
  std::vector<std::uint64_t> next_index_;   // by output
  std::vector<std::uint64_t> next_number_;  // likewise, what could not be written counted, too
};

/// The numbers to begin with; nothing when asked to stop before there is a scan to publish.
std::optional<Positions> wait_for_begin(Service& service, const Outputs& outputs,
                                        Succession& succession) {
  if (!service.wait_for_readers(outputs, succession)) return std::nullopt;
  if (!succession.held()) return Positions();
  service.record.set_state(msg::ServiceState::STATE_HELD);
  while (true) {
    if (const auto begin = succession.begin()) {
      const auto position = begin->positions.find("");
      if (position != begin->positions.end()) {
        service.record.set_first_sequence_number(position->second);
      }
      return begin->positions;
    }
    const auto soon = std::chrono::steady_clock::now() + std::chrono::milliseconds(2);
    if (!service.stop.wait_until(soon)) return std::nullopt;
  }
}

/// What has been written must reach the readers before the writer goes. They may just be getting to
/// know it when a short source is finished, which nobody wants to end at a certain time.
bool all_is_acknowledged(Service& service, const Outputs& outputs) {
  using std::chrono::steady_clock;
  constexpr std::chrono::milliseconds slice{100};
  constexpr std::chrono::seconds longest_wait_when_finished{10};
  const auto begin = steady_clock::now();
  for (const Node::OutputPart& part : outputs) {
    while (!part.output->wait_for_acknowledgments(slice)) {
      service.pulse.beat();
      const auto limit =
          service.stop.requested() ? longest_wait_for_acknowledgments : longest_wait_when_finished;
      if (steady_clock::now() >= begin + limit) return false;
    }
  }
  return true;
}

int publish_all(Service& service, const KindInfo& kind, const PortTypes& types,
                const std::function<void(Source&)>& body) {
  Outputs outputs = make_outputs(service, kind, types);
  for (const Node::OutputPart& part : outputs) service.record.add_output(part.topic);
  Succession succession(service.process.held);
  service.record.set_endpoint_report([&outputs](msg::ServiceStatus& status) {
    status.incompatible_qos(report_outputs(outputs, status));
  });
  SourceSettings settings;
  const Service::Answering answering(
      service, succession, [&](const msg::ControlRequest& request, msg::ControlReply& reply) {
        settings.answer(service.config, request, reply);
      });
  succession.on_request([&] {
    if (succession.asked()) service.stop.request();
  });
  int exit_code = exit_ok;
  Positions next{{"", 0}};
  msg::ServiceState state = msg::ServiceState::STATE_STOPPED;
  std::string detail;
  if (const auto first = wait_for_begin(service, outputs, succession)) {
    service.record.set_state(msg::ServiceState::STATE_ACTIVE);
    PublishingSource source(service, outputs, *first, settings);
    try {
      body(source);
      service.finished = !service.stop.requested();
      if (service.finished) state = msg::ServiceState::STATE_FINISHED;
    } catch (const SourceError& error) {
      spdlog::error("{}", error.what());
      state = msg::ServiceState::STATE_FAILED;
      detail = error.what();
      exit_code = exit_input;
      service.finished = true;
    }
    next = source.next();
  }
  if (!all_is_acknowledged(service, outputs)) {
    spdlog::warn("not all readers have acknowledged the last scans");
  }
  succession.on_request(nullptr);
  succession.left(next, {});
  service.process.heartbeat.finish(service.record, state, detail);
  service.record.set_endpoint_report(nullptr);
  return exit_code;
}

}  // namespace

Component source_component(const KindInfo& kind, DeploymentSourceFactory open, PortTypes types) {
  return {&kind,
          [&kind, open = std::move(open), types = std::move(types)](
              const Deployment& deployment, const ServiceConfig& config) -> Component::Body {
            return [&kind, &types,
                    body = opened(deployment, config, [&] { return open(deployment, config); })](
                       Service& service) { return publish_all(service, kind, types, body); };
          }};
}

Component source_component(const KindInfo& kind, SourceFactory open, PortTypes types) {
  const auto in_deployment = [open = std::move(open)](const Deployment& deployment,
                                                      const ServiceConfig& config) {
    return open(config, deployment.file.parent_path());
  };
  return source_component(kind, DeploymentSourceFactory(in_deployment), std::move(types));
}

}  // namespace quoin::runtime
