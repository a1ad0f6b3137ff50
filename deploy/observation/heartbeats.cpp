// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "deploy/observation/heartbeats.hpp"

#include <algorithm>

#include "core/text/printable.hpp"
#include "services/keys/key_files.hpp"
#include "services/runtime/node/clock.hpp"
#include "services/runtime/process/heartbeat.hpp"

namespace quoin::deploy {

namespace {
using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

constexpr std::size_t most_namespaces = 64;
/// Of processes that the deployment does not name; those of its services are always heard.
constexpr std::size_t most_processes = 4096;
/// For which one writer speaks: as many services as a deployment may have.
constexpr std::size_t most_of_one_writer = 256;
}  // namespace

ServiceReport report_of(const msg::ServiceStatus& status) {
  ServiceReport report;
  report.state = runtime::state_name(status.state());
  report.detail = status.detail();
  report.received = status.received();
  report.first_number = status.first_sequence_number();
  report.published = status.published();
  report.lost = status.lost();
  for (const msg::LossCount& loss : status.losses()) report.losses[loss.cause()] += loss.count();
  report.upstream_lost = status.upstream_lost();
  for (const msg::OutputStatus& output : status.outputs()) {
    report.outputs[output.topic()] = {output.published(), output.lost()};
  }
  report.failures = status.failures();
  report.rate = status.rate();
  report.latency_p50 = status.latency_p50();
  report.latency_p99 = status.latency_p99();
  report.processing_p50 = status.processing_p50();
  report.processing_p99 = status.processing_p99();
  report.resident_memory = status.resident_memory();
  return report;
}

std::optional<LineScatter> line_scatter_of(const msg::ServiceStatus& status) {
  for (const msg::Diagnostic& diagnostic : status.diagnostics()) {
    if (diagnostic.name() == line_scatter_diagnostic) return parse_line_scatter(diagnostic.value());
  }
  return std::nullopt;
}

std::vector<std::string> input_complaints(const msg::ServiceStatus& status) {
  std::vector<std::string> complaints;
  for (const msg::InputStatus& input : status.inputs()) {
    const std::string place = " messages of port " + input.port() + " (" + input.topic() + ") ";
    if (input.duplicates() > 0) {
      complaints.push_back(std::to_string(input.duplicates()) + place +
                           "came before and were not "
                           "used");
    }
    for (const msg::LossCount& refused : input.refused()) {
      complaints.push_back(std::to_string(refused.count()) + place +
                           "were refused: " + refused.cause());
    }
  }
  return complaints;
}

std::vector<std::string> version_lines(
    const std::vector<std::pair<std::string, const msg::ServiceStatus*>>& services) {
  std::map<std::string, std::string> names;  // by version
  for (const auto& [name, status] : services) {
    std::string& list =
        names["Quoin " + printable(status->version()) + " with " + printable(status->dds())];
    list += (list.empty() ? "" : ", ") + name;
  }
  std::vector<std::string> lines;
  for (const auto& [version, list] : names) lines.push_back(version + ": " + list);
  return lines;
}

namespace {

/// Whether the topic is one that a service of this name, or an instance of it, writes. Whoever
/// sends heartbeats may claim any.
bool is_own(const std::string& topic, const std::string& service) {
  const std::string name = service.substr(0, service.find('@'));
  const std::string path = "/" + topic.substr(0, topic.rfind('/'));
  return path.ends_with("/" + name);
}

}  // namespace

std::vector<std::string> foreign_writers(const std::vector<const msg::ServiceStatus*>& statuses) {
  std::map<std::string, std::uint64_t> known;    // writers by topic
  std::map<std::string, std::uint64_t> matched;  // likewise, the most that a reader has
  for (const msg::ServiceStatus* status : statuses) {
    for (const msg::OutputStatus& output : status->outputs()) {
      if (is_own(output.topic(), status->service())) ++known[output.topic()];
    }
    for (const msg::InputStatus& input : status->inputs()) {
      std::uint64_t& most = matched[input.topic()];
      most = std::max<std::uint64_t>(most, input.writers());
    }
  }
  std::vector<std::string> complaints;
  for (const auto& [topic, writers] : matched) {
    const auto own = known.find(topic);  // none: of an external service
    if (own == known.end() || writers <= own->second) continue;
    complaints.push_back("topic " + topic + " has " + std::to_string(writers) +
                         " writers, of which " + std::to_string(own->second) +
                         " report as a service: whatever the others "
                         "write is read, too");
  }
  return complaints;
}

HeartbeatListener::HeartbeatListener(const Deployment& deployment, const std::string& name,
                                     bool all_namespaces)
    : all_namespaces_(all_namespaces),
      participant_(runtime::participant_config(deployment, name, observer_identity)) {
  for (const ServiceConfig& service : deployment.services) {
    known_.emplace(deployment.name_space, label(service));
  }
  if (!all_namespaces) add(deployment.name_space);
}

void HeartbeatListener::add(const std::string& name_space) {
  auto reader = std::make_unique<StatusReader>(participant_, status_topic(name_space),
                                               runtime::QosPreset::state);
  wait_set_.add(*reader);
  readers_[name_space] = std::move(reader);
}

void HeartbeatListener::look_for_namespaces() {
  const std::string ending = status_topic("");
  for (const std::string& topic : participant_.written_topics()) {
    if (!topic.ends_with(ending) || readers_.size() >= most_namespaces) continue;
    const std::string name_space = topic.substr(0, topic.size() - ending.size());
    if (!name_space.empty() && !readers_.contains(name_space)) add(name_space);
  }
}

/// Whether one process more can be kept, of which `status_` came by this writer.
bool HeartbeatListener::has_place(const std::string& name_space, std::uint64_t writer) const {
  const auto others = processes_of_.find(writer);
  if (others != processes_of_.end() && others->second >= most_of_one_writer) return false;
  return heard_.size() < most_processes || known_.contains({name_space, status_.service()});
}

void HeartbeatListener::take(const std::string& name_space, StatusReader& reader) {
  while (reader.take(status_)) {
    const std::int64_t delay = runtime::now_ns() - status_.stamp();
    const std::pair key(name_space, status_.incarnation());
    if (!heard_.contains(key) && !has_place(name_space, reader.last_sample().writer)) continue;
    const auto [entry, first] = heard_.try_emplace(key);
    if (first) ++processes_of_[reader.last_sample().writer];
    HeardHeartbeats& heard = entry->second;
    if (!first) {
      heard.delay = heard.fresh == 0 ? delay : std::min(heard.delay, delay);
      ++heard.fresh;
    }
    if (first || status_.stamp() >= heard.newest.stamp()) heard.newest = status_;
    heard.last = Clock::now();
  }
}

void HeartbeatListener::listen(double seconds, const std::function<bool()>& complete) {
  const auto deadline = Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                           std::chrono::duration<double>(seconds));
  while (!complete() && Clock::now() < deadline) {
    if (all_namespaces_) look_for_namespaces();
    const auto left = std::chrono::ceil<milliseconds>(deadline - Clock::now());
    wait_set_.wait(std::clamp(left, milliseconds(0), milliseconds(100)));
    for (auto& [name_space, reader] : readers_) take(name_space, *reader);
  }
}

std::vector<std::string> HeartbeatListener::unreadable() const {
  std::vector<std::string> texts;
  for (const auto& [name_space, reader] : readers_) {
    for (std::string& text : reader->incompatible_qos()) texts.push_back(std::move(text));
  }
  return texts;
}

std::map<std::pair<std::string, std::string>, HeardHeartbeats> HeartbeatListener::newest() const {
  std::map<std::pair<std::string, std::string>, HeardHeartbeats> services;
  for (const auto& [key, heard] : heard_) {
    HeardHeartbeats& newest = services[{key.first, heard.newest.service()}];
    if (heard.newest.stamp() >= newest.newest.stamp()) newest = heard;
  }
  return services;
}

}  // namespace quoin::deploy
