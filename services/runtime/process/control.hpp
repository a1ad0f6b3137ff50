// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <functional>
#include <idl/Control.h>
#include <mutex>
#include <thread>

#include "services/runtime/dds/reader.hpp"
#include "services/runtime/dds/writer.hpp"
#include "services/runtime/process/service.hpp"

namespace quoin::runtime {

/// Answers the control requests addressed to one service, one after the other, in a thread of its
/// own: what takes long (building a method) happens off the data path. Requests that are larger
/// than any real one, or come while many wait, are refused at once; when even the refusals become
/// too many, requests are dropped and counted.
class ControlServer {
 public:
  /// Answers what is not common to all services: fills accepted, detail, method, parameters and
  /// first_sequence_number of the reply, or throws.
  using Handler = std::function<void(const msg::ControlRequest&, msg::ControlReply&)>;

  ControlServer(Service& service, Succession& succession, Handler handler);
  ~ControlServer();
  ControlServer(const ControlServer&) = delete;
  ControlServer& operator=(const ControlServer&) = delete;

 private:
  using Clock = std::chrono::steady_clock;

  void receive();
  [[nodiscard]] bool for_this_process(const msg::ControlRequest& request) const;
  void accept(const msg::ControlRequest& request);
  void begin_second();
  void refuse(const msg::ControlRequest& request, const std::string& why);
  void work();
  void handle(const msg::ControlRequest& request);
  void carry_out(const msg::ControlRequest& request, msg::ControlReply& reply);
  void answer(const msg::ControlReply& reply);

  Service& service_;
  Succession& succession_;
  Handler handler_;
  std::mutex write_mutex_;
  Writer<msg::ControlReply> writer_;
  Reader<msg::ControlRequest> reader_;
  WaitSet wait_set_;
  std::atomic<bool> ending_{false};
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<msg::ControlRequest> waiting_;
  // Of the receiving thread: what happened in the second that began at second_.
  Clock::time_point second_;
  int accepted_ = 0;
  int refusals_ = 0;
  std::thread receiver_;
  std::thread worker_;
};

}  // namespace quoin::runtime
