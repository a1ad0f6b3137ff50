// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <string>

#include "services/runtime/process/control.hpp"
#include "services/runtime/node/stage.hpp"

namespace quoin::runtime {

/// Exchanges a stage's method or parameters on request: built and validated in the control thread,
/// then handed over between two scans. The stage asks with one atomic load a scan.
template <class In, class Out>
class MethodExchange {
 public:
  MethodExchange(Service& service, const ProcessFactory<In, Out>& make)
      : service_(service),
        make_(make),
        method_(service.config.method),
        wanted_method_(service.config.method),
        parameters_(service.config.parameters),
        server_(service, [this](const msg::ControlRequest& request, msg::ControlReply& reply) {
          handle(request, reply);
        }) {}

  /// Called by the stage before it processes scan `sequence_number`.
  void apply(std::uint64_t sequence_number, Process<In, Out>& process) {
    if (!pending_.load(std::memory_order_acquire)) return;
    const std::lock_guard lock(mutex_);
    if (!next_process_) return;
    process.swap(*next_process_);
    next_process_.reset();
    method_ = wanted_method_;
    service_.heartbeat.set_method(method_);
    first_sequence_number_ = sequence_number;
    pending_.store(false, std::memory_order_release);
    applied_.notify_all();
  }

  /// Method that processes the present scan; for the stage's thread.
  [[nodiscard]] const std::string& method() const { return method_; }

 private:
  void handle(const msg::ControlRequest& request, msg::ControlReply& reply) {
    switch (request.action()) {
      case msg::ControlAction::CONTROL_DESCRIBE:
        break;
      case msg::ControlAction::CONTROL_SWAP_METHOD:
        exchange(request.method(), settings(request), reply);
        break;
      case msg::ControlAction::CONTROL_SET_PARAMETERS:
        exchange(wanted_method_, merged(settings(request)), reply);
        break;
      default:  // the wire may carry any number
        throw std::invalid_argument("unknown action");
    }
    reply.accepted(true);
    reply.method(wanted_method_);
    for (const ParameterSetting& setting : parameters_) {
      msg::ParameterSetting& out = reply.parameters().emplace_back();
      out.name(setting.name);
      out.value(setting.text);
    }
  }

  static ParameterSettings settings(const msg::ControlRequest& request) {
    ParameterSettings result;
    for (const msg::ParameterSetting& setting : request.parameters()) {
      result.push_back({setting.name(), setting.value()});
    }
    return result;
  }

  [[nodiscard]] ParameterSettings merged(const ParameterSettings& changes) const {
    ParameterSettings result = parameters_;
    for (const ParameterSetting& change : changes) {
      const auto same = std::find_if(
          result.begin(), result.end(),
          [&](const ParameterSetting& setting) { return setting.name == change.name; });
      if (same == result.end()) {
        result.push_back(change);
      } else {
        same->text = change.text;
      }
    }
    return result;
  }

  void exchange(const std::string& method, const ParameterSettings& parameters,
                msg::ControlReply& reply) {
    Process<In, Out> process = make_(method, parameters);  // throws, and then nothing has changed
    std::unique_lock lock(mutex_);
    next_process_ = std::move(process);
    wanted_method_ = method;
    parameters_ = parameters;
    pending_.store(true, std::memory_order_release);
    if (!applied_.wait_for(lock, std::chrono::seconds(2), [this] { return !pending_.load(); })) {
      reply.detail("no scan has come since; the next one is handled as requested");
    } else {
      reply.first_sequence_number(first_sequence_number_);
    }
  }

  Service& service_;
  const ProcessFactory<In, Out>& make_;
  std::string method_;            // in force; the stage's thread
  std::string wanted_method_;     // control thread
  ParameterSettings parameters_;  // control thread
  std::atomic<bool> pending_{false};
  std::mutex mutex_;
  std::condition_variable applied_;
  std::optional<Process<In, Out>> next_process_;
  std::uint64_t first_sequence_number_ = 0;
  ControlServer server_;  // last: its thread uses all of the above
};

}  // namespace quoin::runtime
