// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <functional>
#include <idl/Control.h>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "services/runtime/dds/endpoints.hpp"
#include "services/runtime/node/service_record.hpp"
#include "services/runtime/node/succession.hpp"
#include "services/runtime/process/stop_signal.hpp"

namespace quoin::runtime {

/// Who answers control requests, by the thread of the ControlServer.
struct ControlTarget {
  /// Answers what is not common to all services: fills accepted, detail, method, parameters and
  /// first_sequence_number of the reply, or throws.
  using Handler = std::function<void(const msg::ControlRequest&, msg::ControlReply&)>;

  std::string name;   ///< of the service, which its instances share
  std::string label;  ///< of the service
  ServiceRecord* record = nullptr;
  Stop* stop = nullptr;
  Succession* succession = nullptr;
  Handler handler;
};

/// Answers the control requests addressed to the services of a process, one after the other, in a
/// thread of its own: what takes long (building a method) happens off the data path. Requests that
/// are larger than any real one, or come while many wait, are refused at once; when even the
/// refusals become too many, requests are dropped and counted.
class ControlServer {
 public:
  ControlServer(Participant& participant, std::string_view name_space);
  ~ControlServer();
  ControlServer(const ControlServer&) = delete;
  ControlServer& operator=(const ControlServer&) = delete;

  /// From now on requests for this service are answered.
  void add(ControlTarget target);
  /// When this returns, no request for the service is being answered any more, and answers to those
  /// that were have arrived, or were given up after half a second.
  void remove(const std::string& label);

 private:
  using Clock = std::chrono::steady_clock;
  using Target = std::shared_ptr<const ControlTarget>;
  struct Waiting {
    Target target;
    msg::ControlRequest request;
  };

  void receive();
  void accept(const Target& target, const msg::ControlRequest& request);
  void begin_second();
  void refuse(const ControlTarget& target, const msg::ControlRequest& request,
              const std::string& why);
  void work();
  void handle(const ControlTarget& target, const msg::ControlRequest& request);
  void answer(const msg::ControlReply& reply);

  std::mutex write_mutex_;
  Writer<msg::ControlReply> writer_;
  Reader<msg::ControlRequest> reader_;
  WaitSet wait_set_;
  std::atomic<bool> ending_{false};
  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<Target> targets_;
  std::deque<Waiting> waiting_;
  Target at_work_;  // whose request is being answered
  // Of the receiving thread: what happened in the second that began at second_.
  Clock::time_point second_;
  int accepted_ = 0;
  int refusals_ = 0;
  std::thread receiver_;
  std::thread worker_;
};

}  // namespace quoin::runtime
