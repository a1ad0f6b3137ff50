// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <idl/Control.h>
#include <optional>
#include <string>

#include "deploy/orchestration/requester.hpp"
#include "deploy/orchestration/supervised_processes.hpp"
#include "services/deployment/deployment.hpp"

namespace quoin::deploy {

/// Requests to supervised processes whose answers are waited for while the supervision goes on.
class Dialogue {
 public:
  /// `pump` is what pump() does. Both others must outlive the object.
  Dialogue(const SupervisedProcesses& processes, Requester& requester, std::function<bool()> pump);

  /// Nothing when the process does not answer. Incarnation 0 stands for any process of the service.
  [[nodiscard]] std::optional<msg::ControlReply> ask(const std::string& service,
                                                     std::uint64_t incarnation,
                                                     msg::ControlAction action);
  /// The same with what the request carries besides.
  [[nodiscard]] std::optional<msg::ControlReply> ask(const std::string& service,
                                                     std::uint64_t incarnation,
                                                     msg::ControlRequest request);

  struct Swap {
    std::string refusal;                                     ///< why not; "" when it was done
    std::optional<std::uint64_t> first_scan = std::nullopt;  ///< that the new method handled
  };
  /// Gives a running service the method and parameters of `config`.
  [[nodiscard]] Swap swap(const ServiceConfig& config);

  /// What the processes of `deployment` do at present: the same, but with the methods and
  /// parameters that were exchanged by request.
  [[nodiscard]] Deployment describe(const Deployment& deployment);

  [[nodiscard]] Requester::Clock::time_point now() const { return requester_.now(); }
  /// Lets the processes be supervised for a moment; false when the deployment is to stop.
  bool pump() { return pump_(); }
  /// False after `timeout`, or when the deployment is to stop.
  bool wait_until(const std::function<bool()>& condition, std::chrono::milliseconds timeout);

 private:
  [[nodiscard]] std::optional<msg::ControlReply> answer(msg::ControlRequest& request,
                                                        std::chrono::milliseconds timeout);

  const SupervisedProcesses& processes_;
  Requester& requester_;
  std::function<bool()> pump_;
};

}  // namespace quoin::deploy
