// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace quoin::deploy {

/// What one process of a service has told of itself.
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
  /// What is known from elsewhere of what that process had published at least.
  void published_at_least(std::uint64_t incarnation, std::uint64_t count) {
    published_at_least_[incarnation] = std::max(published_at_least_[incarnation], count);
  }
  /// Takes back what is known of a process that never did anything.
  void forget(std::uint64_t incarnation) { reports_.erase(incarnation); }
  [[nodiscard]] ServiceReport total() const;
  /// The newest report of each process, with what is known from elsewhere; by incarnation.
  [[nodiscard]] std::map<std::uint64_t, ServiceReport> processes() const;

 private:
  std::map<std::uint64_t, ServiceReport> reports_;
  std::map<std::uint64_t, std::uint64_t> published_at_least_;
};

struct ServiceFigures {
  std::string name;
  std::string kind;
  std::string method;  ///< "" for kinds without methods
  ServiceReport report;
  std::uint64_t restarts = 0;
  std::string host = {};  ///< where it runs, as far as that is known
  double age = -1.0;      ///< [s] of its last heartbeat; negative: none was heard
};

/// What arrived at the end of a chain, seen from outside.
struct CornerFigures {
  std::string name;
  std::uint64_t scans_expected = 0;  ///< delivered + lost
  std::uint64_t scans_delivered = 0;
  std::uint64_t scans_lost = 0;
  std::map<std::string, std::uint64_t> lost_by_stage;
  double mean_corners = 0.0;         ///< per scan
  double median_sigma = 0.0;         ///< [m] sqrt((Cxx + Cyy) / 2)
  double median_ellipse_area = 0.0;  ///< [m^2] one-sigma ellipse
};

struct DeploymentFigures {
  std::string deployment;  ///< file
  double duration = 0.0;   ///< [s]
  std::uint64_t scans_published = 0;
  std::vector<ServiceFigures> services;
  std::vector<CornerFigures> corners;
};

}  // namespace quoin::deploy
