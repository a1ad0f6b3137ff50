// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/ros2_output/heartbeat_relay.hpp"

#include <chrono>
#include <condition_variable>
#include <idl/Status.h>
#include <map>
#include <mutex>
#include <thread>

#include "services/deployment/deployment.hpp"
#include "services/ros2/diagnostics.hpp"
#include "services/ros2_output/publication.hpp"
#include "services/runtime/node/clock.hpp"

namespace quoin {

namespace {

constexpr std::chrono::seconds period{1};

}  // namespace

struct HeartbeatRelay::Impl {
  Impl(runtime::Participant& participant, const std::string& owner, std::string name_space_of_all)
      : name_space(std::move(name_space_of_all)),
        heartbeats(participant, status_topic(name_space), runtime::QosPreset::state),
        diagnostics(participant, owner, "/diagnostics", false),
        thread([this](const std::stop_token& stop) { run(stop); }) {}

  void run(const std::stop_token& stop) {
    std::mutex mutex;
    std::condition_variable_any never;
    std::unique_lock lock(mutex);
    while (!never.wait_for(lock, stop, period, [&] { return stop.stop_requested(); })) publish();
  }

  void publish() {
    msg::ServiceStatus status;
    while (heartbeats.take(status)) newest[status.service()] = status;
    if (newest.empty() || !diagnostics.wanted()) return;
    const std::int64_t now = runtime::now_ns();
    ros2::DiagnosticArray& array = diagnostics.message();
    ros2::set_header(array.header(), now, "");
    array.status().resize(newest.size());
    std::size_t used = 0;
    for (const auto& [service, heartbeat] : newest) {
      ros2::fill_diagnostic(heartbeat, now - heartbeat.stamp(), name_space, array.status()[used++]);
    }
    diagnostics.write();
  }

  const std::string name_space;
  runtime::Reader<msg::ServiceStatus> heartbeats;
  TypedPublication<ros2::DiagnosticArray> diagnostics;
  std::map<std::string, msg::ServiceStatus> newest;
  std::jthread thread;  // ends before what it uses
};

HeartbeatRelay::HeartbeatRelay(runtime::Participant& participant, const std::string& owner,
                               const std::string& name_space)
    : impl_(std::make_unique<Impl>(participant, owner, name_space)) {}

HeartbeatRelay::~HeartbeatRelay() = default;

}  // namespace quoin
