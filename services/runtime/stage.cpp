// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/runtime/stage.hpp"

#include <exception>
#include <idl/Corners.h>
#include <idl/Lines.h>
#include <idl/Scan.h>
#include <idl/Segments.h>

#include <spdlog/spdlog.h>

#include "services/runtime/accounting.hpp"
#include "services/runtime/clock.hpp"
#include "services/runtime/delivery.hpp"
#include "services/runtime/method_exchange.hpp"
#include "services/runtime/reader.hpp"
#include "services/runtime/service.hpp"

namespace quoin::runtime {

namespace {

constexpr std::chrono::seconds longest_wait{1};

/// Reads, processes, publishes and accounts for one service, in the thread that calls run().
template <class In, class Out>
class Stage {
 public:
  Stage(Service& service, Process<In, Out> process, const ProcessFactory<In, Out>& make)
      : service_(service),
        pulse_(service.heartbeat.pulse()),
        process_(std::move(process)),
        lossless_(qos_preset(service.config.qos) == QosPreset::lossless),
        writer_(service.participant, deploy::output_topic(service.deployment, service.config),
                output_qos(service.config)),
        exchange_(service, make) {}

  int run() {
    // The input is opened once the output has its readers: so a whole deployment comes up from its
    // end to its sources, and the first scan finds everybody listening.
    if (service_.wait_for_readers(writer_)) {
      const deploy::ServiceConfig& input = service_.deployment.service(service_.config.input);
      Reader<In> reader(service_.participant, deploy::output_topic(service_.deployment, input),
                        output_qos(input));
      read(reader);
    }
    service_.heartbeat.stopping();
    if (!writer_.wait_for_acknowledgments(std::chrono::seconds(2))) {
      spdlog::warn("not all readers have acknowledged the last results");
    }
    service_.heartbeat.finish(msg::ServiceState::STATE_STOPPED);
    return exit_ok;
  }

 private:
  void read(Reader<In>& reader) {
    service_.heartbeat.set_endpoint_report([&](msg::ServiceStatus& status) {
      status.matched_inputs(static_cast<std::uint32_t>(reader.matched()));
      status.matched_outputs(static_cast<std::uint32_t>(writer_.matched()));
      status.incompatible_qos(writer_.incompatible_qos());
      for (std::string& text : reader.incompatible_qos()) {
        status.incompatible_qos().push_back(std::move(text));
      }
    });
    WaitSet wait_set;
    wait_set.add(reader);
    service_.stop.on_request([&] { wait_set.wake(); });
    service_.heartbeat.set_state(msg::ServiceState::STATE_ACTIVE);
    bool stopping = false;
    while (!stopping) {
      wait_for_input(wait_set);
      // Asked before the last round of taking: what was received until then is still processed.
      stopping = service_.stop.requested();
      while (reader.take(in_)) handle();
    }
    service_.stop.on_request(nullptr);
    service_.heartbeat.set_endpoint_report(nullptr);
  }

  /// An instance that stands by, or is stood by for, tells that it lives; from this loop, so that
  /// one whose method hangs is replaced.
  void wait_for_input(WaitSet& wait_set) {
    pulse_.wait_until(Pulse::Clock::now() + longest_wait);
    if (!service_.config.strength) {
      wait_set.wait(longest_wait);
    } else if (!wait_set.wait(service_.config.lease / 4)) {
      writer_.assert_liveliness();
    }
  }

  void handle() {
    pulse_.beat();
    const std::int64_t received = now_ns();
    std::uint64_t link_lost = 0;
    std::uint64_t upstream_lost = 0;
    for (const Loss& loss : accounting_.receive(in_.header())) {
      (loss.stage == "link" ? link_lost : upstream_lost) += loss.count;
      spdlog::warn("{} scans of {}..{} lost by {}", loss.count, loss.first_sequence,
                   loss.last_sequence, loss.stage);
    }
    if (accounting_.last_was_duplicate()) return;
    service_.heartbeat.count_received(upstream_lost, link_lost);
    exchange_.apply(in_.header().sequence_number(), process_);
    publish(received);
  }

  void publish(std::int64_t received) {
    std::size_t failures = 0;
    try {
      failures = process_(in_, out_);
    } catch (const std::exception& error) {
      service_.heartbeat.count_loss(LossCause::processing);
      spdlog::error("scan {}: {}", in_.header().sequence_number(), error.what());
      return;
    }
    out_.header(in_.header());
    msg::StageTrace& trace = out_.header().trace().emplace_back();
    trace.service(service_.config.name);
    trace.method(exchange_.method());
    trace.incarnation(service_.heartbeat.incarnation());
    trace.index(next_index_);
    trace.received(received);
    if (!deliver(writer_, out_, trace, lossless_, service_.stop, pulse_)) {
      service_.heartbeat.count_loss(LossCause::publishing);
      return;
    }
    ++next_index_;
    const auto& first = in_.header().trace();
    service_.heartbeat.count_published(first.empty() ? received : first.front().published(),
                                       received, trace.published(), failures);
  }

  Service& service_;
  Pulse& pulse_;
  Process<In, Out> process_;
  bool lossless_;
  Writer<Out> writer_;
  MethodExchange<In, Out> exchange_;
  ScanAccounting accounting_;
  std::uint64_t next_index_ = 0;
  In in_;    // memory is kept from scan to scan
  Out out_;  // likewise
};

}  // namespace

template <class In, class Out>
int run_stage(int argc, char** argv, const std::string& kind, const ProcessFactory<In, Out>& make) {
  Process<In, Out> process;
  return run_service(
      argc, argv, kind,
      [&](const deploy::Deployment&, const deploy::ServiceConfig& config) {
        process = make(config.method, config.parameters);
      },
      [&](Service& service) { return Stage<In, Out>(service, std::move(process), make).run(); });
}

// A new stage is one line here.
template int run_stage<msg::Scan, msg::Segments>(int, char**, const std::string&,
                                                 const ProcessFactory<msg::Scan, msg::Segments>&);
template int run_stage<msg::Segments, msg::Lines>(int, char**, const std::string&,
                                                  const ProcessFactory<msg::Segments, msg::Lines>&);
template int run_stage<msg::Lines, msg::Corners>(int, char**, const std::string&,
                                                 const ProcessFactory<msg::Lines, msg::Corners>&);

}  // namespace quoin::runtime
