// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace quoin::deploy {

/// What a process has reported of one topic.
struct OutputReport {
  std::uint64_t published = 0;
  std::uint64_t lost = 0;
};

/// What one process of a service has reported of itself.
struct ServiceReport {
  std::string
      state;  ///< starting, active, finished, stopped or failed; what the supervisor knows else
  std::string detail;  ///< reason of the state
  std::uint64_t received = 0;
  std::uint64_t first_number = 0;  ///< of a source: number of the first scan
  std::uint64_t published = 0;
  std::uint64_t lost = 0;
  std::map<std::string, std::uint64_t> losses;  ///< by cause
  std::uint64_t upstream_lost = 0;
  std::map<std::string, OutputReport> outputs;  ///< by topic
  std::uint64_t failures = 0;
  double rate = 0.0;                  ///< [Hz]
  double latency_p50 = 0.0;           ///< [s] from the scan's publication
  double latency_p99 = 0.0;           ///< [s]
  double processing_p50 = 0.0;        ///< [s]
  double processing_p99 = 0.0;        ///< [s]
  std::uint64_t resident_memory = 0;  ///< [byte]
};

/// The reports of a service over all its processes: counters are summed, the rest is the newest.
class Incarnations {
 public:
  /// Takes the newest report of the process that started at `incarnation` [ns since the Unix
  /// epoch].
  void update(std::uint64_t incarnation, const ServiceReport& report) {
    reports_[incarnation] = report;
  }
  /// The topic that `published` of a report counts.
  void set_topic(const std::string& topic) { topic_ = topic; }
  /// What is known from elsewhere of what that process had published on a topic at least.
  void published_at_least(std::uint64_t incarnation, const std::string& topic,
                          std::uint64_t count) {
    std::uint64_t& known = published_at_least_[{incarnation, topic}];
    known = std::max(known, count);
  }
  /// Takes back what is known of a process that never did anything.
  void forget(std::uint64_t incarnation) { reports_.erase(incarnation); }
  [[nodiscard]] ServiceReport total() const;
  /// The newest report of each process, with what is known from elsewhere; by incarnation.
  [[nodiscard]] std::map<std::uint64_t, ServiceReport> processes() const;

 private:
  std::map<std::uint64_t, ServiceReport> reports_;
  std::map<std::pair<std::uint64_t, std::string>, std::uint64_t> published_at_least_;
  std::string topic_;
};

struct ServiceFigures {
  std::string name;
  std::string kind;
  std::string method;  ///< "" for kinds without methods
  ServiceReport report;
  std::uint64_t restarts = 0;
  std::string host = {};  ///< where it runs, as far as that is known
  double age = -1.0;      ///< [s] of its last heartbeat; negative: none was heard
  /// Messages published on each output that numbers them (a source's scans, and what has a rate of
  /// its own), by type.
  std::map<std::string, std::uint64_t> numbered = {};
};

/// Lost scans by where they were lost.
struct LossFigures {
  std::map<std::string, std::uint64_t> by_service;
  std::uint64_t on_link = 0;   ///< between the last service and the one who counts
  std::uint64_t at_start = 0;  ///< before the first that arrived
  std::uint64_t at_end = 0;    ///< behind the last one

  [[nodiscard]] std::uint64_t sum() const {
    std::uint64_t all = on_link + at_start + at_end;
    for (const auto& [service, count] : by_service) all += count;
    return all;
  }
};

/// Of an output that gives corners.
struct CornerFigures {
  double mean_corners = 0.0;         ///< per scan
  double median_sigma = 0.0;         ///< [m] sqrt((Cxx + Cyy) / 2)
  double median_ellipse_area = 0.0;  ///< [m^2] one-sigma ellipse
};

/// Of an output that gives poses.
struct PoseFigures {
  std::uint64_t tracking = 0;
  std::uint64_t ambiguous = 0;
  std::uint64_t lost = 0;
  std::string status;  ///< of the last one: tracking, ambiguous or lost
  double x = 0.0;      ///< [m] of the last one
  double y = 0.0;      ///< [m]
  double theta = 0.0;  ///< [rad]
};

/// Of an output that gives a map.
struct MapFigures {
  std::uint64_t walls = 0;
  double length = 0.0;  ///< [m] of all
};

/// What arrived at an output that no service reads, seen from outside.
struct EndFigures {
  std::string name;                  ///< of the service, or service/type where it has several ends
  std::string type;                  ///< of the messages
  std::uint64_t scans_expected = 0;  ///< delivered + lost
  std::uint64_t scans_delivered = 0;
  LossFigures lost = {};
  double latency_p50 = 0.0;  ///< [s] from the publication by the source to that by this service
  double latency_p99 = 0.0;  ///< [s]
  std::optional<CornerFigures> corners = std::nullopt;
  std::optional<PoseFigures> pose = std::nullopt;
  std::optional<MapFigures> map = std::nullopt;
};

struct DeploymentFigures {
  std::string deployment;  ///< file
  double duration = 0.0;   ///< [s]
  std::uint64_t scans_published = 0;
  std::vector<ServiceFigures> services;
  std::vector<EndFigures> ends;
};

}  // namespace quoin::deploy
