// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "deploy/observation/monitor.hpp"

#include "services/keys/key_files.hpp"
#include "services/runtime/dds/qos.hpp"
#include "services/topics/topic_types.hpp"

namespace quoin::deploy {

using std::chrono::milliseconds;
using std::chrono::steady_clock;

Monitor::Monitor(const Deployment& deployment, const std::string& host)
    : participant_(runtime::participant_config(deployment, "quoin", operator_identity)),
      status_reader_(participant_, status_topic(deployment.name_space), runtime::QosPreset::state),
      record_(deployment, host, [this](std::size_t end, const Connection& connection) {
        listen_to(end, connection);
      }) {
  wait_set_.add(status_reader_);
  thread_ = std::thread([this] { listen(); });
}

void Monitor::listen_to(std::size_t end, const Connection& connection) {
  const OutputConfig& output = connection.output;
  const std::string type(topics::find_topic_type(connection.type)->dds_type);
  const std::lock_guard lock(ends_mutex_);
  ends_.push_back(std::unique_ptr<End>(new End{
      end,
      connection.type,
      topics::message_check(type),
      {participant_, output.topic, type, runtime::output_qos(*connection.writer, output)}}));
  wait_set_.add(ends_.back()->reader);
}

Monitor::~Monitor() { stop(); }

void Monitor::stop() {
  ending_ = true;
  wait_set_.wake();
  if (thread_.joinable()) thread_.join();
}

void Monitor::listen() {
  while (!ending_) {
    wait_set_.wait(milliseconds(200));
    take_all();
    memory_trim_.tick();
  }
}

void Monitor::take_all() {
  const std::lock_guard lock(ends_mutex_);
  while (status_reader_.take(status_)) record_.receive(status_);
  for (const auto& end : ends_) take_all(*end);
}

void Monitor::take_all(End& end) {
  while (end.reader.take(raw_)) {
    // No message of ours, or not of whom it says.
    if (end.check->refusal(raw_.cdr) || !topics::read_header(raw_, header_)) continue;
    if (!end.reader.admit(header_)) continue;
    EndMessage message;
    if (end.type == "corners" && topics::decode(raw_, corners_)) message = &corners_;
    if (end.type == "pose" && topics::decode(raw_, pose_)) message = &pose_;
    if (end.type == "line_map" && topics::decode(raw_, map_)) message = &map_;
    record_.receive(end.number, header_, message);
  }
}

void Monitor::finish(const std::vector<std::string>& names, milliseconds timeout) {
  const auto deadline = steady_clock::now() + timeout;
  while (!record_.have_ended(names) && steady_clock::now() < deadline) {
    std::this_thread::sleep_for(milliseconds(5));
  }
  stop();
  take_all();
  record_.close();
}

}  // namespace quoin::deploy
