// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <idl/Control.h>
#include <thread>

#include "services/runtime/reader.hpp"
#include "services/runtime/service.hpp"
#include "services/runtime/writer.hpp"

namespace quoin::runtime {

/// Answers the control requests addressed to one service, one after the other, in a thread of its
/// own: what takes long (building a method) happens off the data path.
class ControlServer {
 public:
  /// Answers what is not common to all services: fills accepted, detail, method, parameters and
  /// first_sequence_number of the reply, or throws.
  using Handler = std::function<void(const msg::ControlRequest&, msg::ControlReply&)>;

  ControlServer(Service& service, Handler handler);
  ~ControlServer();
  ControlServer(const ControlServer&) = delete;
  ControlServer& operator=(const ControlServer&) = delete;

 private:
  void run();
  [[nodiscard]] bool addressed(const msg::ControlRequest& request) const;
  void answer(const msg::ControlRequest& request, msg::ControlReply& reply);

  Service& service_;
  Handler handler_;
  Writer<msg::ControlReply> writer_;
  Reader<msg::ControlRequest> reader_;
  WaitSet wait_set_;
  std::atomic<bool> ending_{false};
  std::thread thread_;
};

}  // namespace quoin::runtime
