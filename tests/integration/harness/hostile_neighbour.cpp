// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/integration/harness/hostile_neighbour.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "services/runtime/dds/qos.hpp"
#include "services/topics/header.hpp"

namespace quoin::tests {

namespace {

constexpr std::size_t largest_scan = 100'000;
constexpr std::size_t most_statuses = 64;

}  // namespace

template <class T>
HostileNeighbour::Topic<T>::Topic(runtime::Participant& participant,
                                  const TestDeployment& deployment, const std::string& service)
    : reader(participant, deployment.topic(service), topics::cdr_codec<T>().type_name,
             runtime::observer_qos(deployment.deployment().service(service),
                                   deployment.output(service))),
      writer(participant, deployment.topic(service), topics::cdr_codec<T>().type_name,
             runtime::output_qos(deployment.deployment().service(service),
                                 deployment.output(service))) {}

HostileNeighbour::HostileNeighbour(const TestDeployment& deployment, const std::string& source,
                                   const std::string& segmentation, const std::string& lines,
                                   std::uint64_t seed)
    : random_(seed),
      participant_(deployment.participant("neighbour")),
      scans_(participant_, deployment, source),
      segments_(participant_, deployment, segmentation),
      lines_(participant_, deployment, lines),
      heard_statuses_(participant_, status_topic(deployment.deployment().name_space),
                      runtime::QosPreset::state),
      statuses_(participant_, status_topic(deployment.deployment().name_space),
                runtime::QosPreset::state),
      requests_(participant_, control_request_topic(deployment.deployment().name_space),
                runtime::QosPreset::control) {}

std::uint64_t HostileNeighbour::below(std::uint64_t count) {
  return std::uniform_int_distribution<std::uint64_t>(0, count - 1)(random_);
}

std::string HostileNeighbour::nonsense(std::size_t longest) {
  std::string text(1 + below(longest), ' ');
  for (char& character : text) character = static_cast<char>(1 + below(255));
  return text + "\n\x1b[2Jerror: a forged line";
}

template <class T>
void HostileNeighbour::listen(Topic<T>& topic) {
  topics::RawMessage raw;
  T message;
  while (topic.reader.take(raw)) {
    if (!topics::decode(raw, message) || message.header().trace().empty()) continue;
    // Its own come back; those of the services follow each other.
    const bool next = topic.heard && message.header().trace().back().index() ==
                                         topic.last.header().trace().back().index() + 1;
    if (topic.heard && !next && below(4) != 0) continue;
    topic.last = message;
    topic.heard = true;
  }
}

void HostileNeighbour::listen() {
  listen(scans_);
  listen(segments_);
  listen(lines_);
  msg::ServiceStatus status;
  while (heard_statuses_.take(status)) {
    const auto known = std::ranges::find_if(last_statuses_, [&](const msg::ServiceStatus& other) {
      return other.service() == status.service();
    });
    if (known != last_statuses_.end()) {
      *known = status;
    } else if (last_statuses_.size() < most_statuses) {
      last_statuses_.push_back(status);
    }
  }
}

bool HostileNeighbour::informed() const {
  return scans_.heard && segments_.heard && lines_.heard && !last_statuses_.empty();
}

/// In the name of the process that was heard last, but for what `change` makes of it.
template <class T, class Change>
void HostileNeighbour::send(Topic<T>& topic, const char* kind, Change change) {
  if (!topic.heard) return;
  T message = topic.last;
  change(message);
  topics::RawMessage raw;
  topics::encode(message, raw);
  if (topic.writer.write(raw)) ++counts_[kind];
}

template <class T>
void HostileNeighbour::send_garbage(Topic<T>& topic) {
  topics::RawMessage raw;
  topics::encode(topic.last, raw);
  for (int i = 0; i < 20; ++i) {
    raw.cdr[4 + below(raw.cdr.size() - 4)] = static_cast<std::byte>(below(256));
  }
  if (below(4) == 0) raw.cdr.resize(4 + below(raw.cdr.size() - 4));
  if (topic.writer.write(raw)) ++counts_["garbage"];
}

void HostileNeighbour::attack_scans() {
  const auto number = [](msg::Scan& scan, std::uint64_t ahead) {
    scan.header().origins()[0].sequence_number() += ahead;
    scan.header().trace()[0].index() += ahead;
  };
  send(scans_, "jump beyond all", [&](msg::Scan& scan) { number(scan, std::uint64_t{1} << 60U); });
  send(scans_, "jump", [&](msg::Scan& scan) { number(scan, 900); });
  send(scans_, "repetition", [](msg::Scan&) {});
  send(scans_, "foreign stamp", [&](msg::Scan& scan) {
    scan.header().trace()[0].published(std::numeric_limits<std::int64_t>::min());
  });
  send(scans_, "scan without end", [&](msg::Scan& scan) {
    scan.bearings().resize(largest_scan + 1);
    scan.ranges().resize(largest_scan + 1);
  });
  send(scans_, "largest scan", [&](msg::Scan& scan) {
    scan.bearings().resize(largest_scan);
    scan.ranges().resize(largest_scan);
    scan.qualities().clear();
    scan.time_offsets().clear();
    for (std::size_t i = 0; i < largest_scan; ++i) {
      scan.bearings()[i] = 6.28F * static_cast<float>(i) / static_cast<float>(largest_scan);
      scan.ranges()[i] = 3.0F + 0.01F * static_cast<float>(i % 40);
    }
  });
  send(scans_, "noise", [](msg::Scan& scan) {
    scan.sensor_model().range_stddev(0.0);
    scan.sensor_model().range_bias_stddev(1e300);
  });
  send(scans_, "invented trace", [&](msg::Scan& scan) {
    scan.header().trace().resize(2 + below(20'000));
    scan.header().trace()[1].service(nonsense(10));
  });
  send(scans_, "name",
       [&](msg::Scan& scan) { scan.header().trace()[0].service(nonsense(80'000)); });
}

void HostileNeighbour::attack_segments() {
  send(segments_, "overlap", [](msg::Segments& segments) {
    segments.bearings().assign(largest_scan, 0.5F);
    segments.ranges().assign(largest_scan, 2.0F);
    segments.segments().resize(largest_scan);
    for (msg::IndexRange& range : segments.segments()) range.end(largest_scan);
  });
  send(segments_, "outside", [](msg::Segments& segments) {
    segments.segments().resize(1);
    segments.segments()[0].end(4'000'000'000U);
  });
}

void HostileNeighbour::attack_lines() {
  for (const double variance : {-1.0, 0.0, std::nan(""), 1e300}) {
    send(lines_, "variance", [&](msg::Lines& lines) {
      if (lines.lines().empty()) lines.lines().resize(1);
      for (msg::Line& line : lines.lines()) {
        line.covariance_r(variance);
        line.covariance_direction(variance);
      }
    });
  }
}

void HostileNeighbour::attack_heartbeats() {
  for (const msg::ServiceStatus& heard : last_statuses_) {
    msg::ServiceStatus forged = heard;
    forged.lost(std::numeric_limits<std::uint64_t>::max() - 50);
    statuses_.write(forged);
    forged.lost(below(1000));
    forged.published(0);
    forged.state(msg::STATE_FAILED);
    forged.detail(nonsense(40));
    statuses_.write(forged);
    forged.detail("");
    statuses_.write(forged);
  }
  for (int i = 0; i < 8; ++i) {
    msg::ServiceStatus ghost;
    ghost.service("ghost_" + std::to_string(below(512)));
    ghost.pid(std::numeric_limits<std::int32_t>::max());
    ghost.incarnation(below(1'000'000'000));
    ghost.state(msg::STATE_ACTIVE);
    statuses_.write(ghost);
  }
  ++counts_["heartbeats"];
}

void HostileNeighbour::attack_control() {
  msg::ControlRequest request;
  request.service(last_statuses_.empty() ? "front"
                                         : last_statuses_[below(last_statuses_.size())].service());
  request.requester(nonsense(2000));
  request.action(msg::ControlAction::CONTROL_SET_PARAMETERS);
  request.parameters().resize(1 + below(100));
  request.parameters()[0].name(nonsense(8000));
  requests_.write(request);
  ++counts_["requests"];
}

void HostileNeighbour::attack() {
  if (!informed()) return;
  attack_scans();
  attack_segments();
  attack_lines();
  attack_heartbeats();
  attack_control();
  for (int i = 0; i < 10; ++i) {
    send_garbage(scans_);
    send_garbage(segments_);
    send_garbage(lines_);
  }
}

}  // namespace quoin::tests
