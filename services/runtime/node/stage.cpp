// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/runtime/node/stage.hpp"

#include <exception>
#include <idl/Corners.h>
#include <idl/Lines.h>
#include <idl/Scan.h>
#include <idl/Segments.h>
#include <optional>
#include <vector>

#include <spdlog/spdlog.h>

#include "services/runtime/accounting/accounting.hpp"
#include "services/runtime/process/clock.hpp"
#include "services/runtime/node/delivery.hpp"
#include "services/runtime/node/method_exchange.hpp"
#include "services/runtime/dds/reader.hpp"
#include "services/runtime/process/service.hpp"
#include "services/topics/header.hpp"

namespace quoin::runtime {

namespace {

// Scans that a held process keeps between two steps of the succession, which take milliseconds.
constexpr std::size_t most_kept = 1024;
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
        writer_(service.participant, output_topic(service.deployment, service.config),
                output_qos(service.config)),
        exchange_(service, make) {}

  int run() {
    // The input is opened once the output has its readers: so a whole deployment comes up from its
    // end to its sources, and the first scan finds everybody listening.
    if (service_.wait_for_readers(writer_)) {
      const ServiceConfig& input = service_.deployment.service(service_.config.input);
      Reader<In> reader(service_.participant, output_topic(service_.deployment, input),
                        output_qos(input));
      read(reader);
    }
    service_.heartbeat.stopping();
    if (!writer_.wait_for_acknowledgments(longest_wait_for_acknowledgments)) {
      spdlog::warn("not all readers have acknowledged the last results");
    }
    service_.succession.left(next_sequence_);
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
    service_.succession.on_request([&] { wait_set.wake(); });
    if (!service_.succession.held() || hold(reader, wait_set)) work(reader, wait_set);
    service_.succession.on_request(nullptr);
    service_.stop.on_request(nullptr);
    service_.heartbeat.set_endpoint_report(nullptr);
  }

  void work(Reader<In>& reader, WaitSet& wait_set) {
    service_.heartbeat.set_state(msg::ServiceState::STATE_ACTIVE);
    for (In& scan : kept_) {
      in_ = std::move(scan);
      handle();
    }
    kept_.clear();
    bool ending = false;
    while (!ending) {
      wait_for_input(wait_set);
      // Asked before the last round of taking: what was received until then is still processed.
      ending = service_.stop.requested();
      bool leaving = service_.succession.leaves(next_sequence_);
      while (!leaving && reader.take(in_)) {
        leaving = service_.succession.leaves(topics::sequence_number(in_.header()));
        if (!leaving) handle();
        leaving = leaving || service_.succession.leaves(next_sequence_);
      }
      ending = ending || leaving;
    }
  }

  /// Receives without publishing until this process is to begin; false when it is to stop instead.
  bool hold(Reader<In>& reader, WaitSet& wait_set) {
    service_.heartbeat.set_state(msg::ServiceState::STATE_STARTING, "waiting for its input");
    while (!reader.wait_for_writers(1, std::chrono::milliseconds(20))) {
      if (service_.stop.requested()) return false;
    }
    service_.heartbeat.set_state(msg::ServiceState::STATE_HELD);
    while (!service_.stop.requested()) {
      while (kept_.size() < most_kept && reader.take(in_)) {
        if (!service_.succession.keep(topics::sequence_number(in_.header()))) kept_.clear();
        kept_.push_back(in_);
      }
      begin_with_ = service_.succession.begin();
      if (begin_with_) return true;
      if (kept_.size() < most_kept) {
        wait_for_input(wait_set);
      } else {
        // What has no place stays with DDS, as it does when processing is too slow.
        (void)service_.stop.wait_until(std::chrono::steady_clock::now() +
                                       std::chrono::milliseconds(2));
      }
    }
    return false;
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
    const std::uint64_t number = topics::sequence_number(in_.header());
    // The predecessor has handled these; with another input they may come late.
    if (begin_with_ && number < *begin_with_) return;
    begin_with_.reset();
    const std::int64_t received = now_ns();
    std::uint64_t link_lost = 0;
    std::uint64_t upstream_lost = 0;
    for (const Loss& loss : accounting_.receive(in_.header())) {
      (loss.stage == "link" ? link_lost : upstream_lost) += loss.count;
      spdlog::warn("{} scans of {}..{} lost by {}", loss.count, loss.first_sequence,
                   loss.last_sequence, loss.stage);
    }
    if (accounting_.last_was_duplicate()) return;
    next_sequence_ = number + 1;
    service_.heartbeat.count_received(upstream_lost, link_lost);
    exchange_.apply(number, process_);
    publish(received);
  }

  void publish(std::int64_t received) {
    std::size_t failures = 0;
    try {
      failures = process_(in_, out_);
    } catch (const std::exception& error) {
      service_.heartbeat.count_loss(LossCause::processing);
      spdlog::error("scan {}: {}", topics::sequence_number(in_.header()), error.what());
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
  std::uint64_t next_sequence_ = 0;          // of the scan after the last one that was handled
  std::vector<In> kept_;                     // while held
  std::optional<std::uint64_t> begin_with_;  // until that scan has come
  In in_;                                    // memory is kept from scan to scan
  Out out_;                                  // likewise
};

}  // namespace

template <class In, class Out>
int run_stage(int argc, char** argv, const std::string& kind, const ProcessFactory<In, Out>& make) {
  Process<In, Out> process;
  return run_service(
      argc, argv, kind,
      [&](const Deployment&, const ServiceConfig& config) {
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
