// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/evaluation/corner_matching.hpp"
#include "core/geometry/corner.hpp"
#include "core/statistics/order_statistics.hpp"
#include "deploy/observation/comparison_figures.hpp"

namespace quoin::deploy {

/// Which scan a result is of. Ordered in time for the scans of one sensor.
struct ScanKey {
  std::string sensor;
  std::uint64_t incarnation = 0;  ///< start of the source [ns since the Unix epoch]
  std::uint64_t sequence_number = 0;

  friend auto operator<=>(const ScanKey&, const ScanKey&) = default;
};

/// What a corner service made of a scan.
struct CornerResult {
  std::vector<CornerEstimate> corners;
  double latency = 0.0;  ///< [s] from the scan's publication to the corners'
  std::string methods;   ///< of the stages that made it
};

/// Brings the results of several corner services on the same scans together and compares them with
/// those of one of them.
class Comparison {
 public:
  /// `reference` is an index into `services`. `most_scans`: later scans are left out; 0: no end.
  Comparison(const std::vector<std::string>& services, std::size_t reference,
             const MatchingGate& gate, std::uint64_t most_scans = 0);

  /// Takes a result. Each service delivers in the order of the scans, so that what it has passed by
  /// is missing. Before its first result a service was not listened to yet.
  void add(std::size_t service, const ScanKey& scan, CornerResult result);

  /// No further scan is opened; results of open ones are still taken.
  void close() { closed_ = true; }
  /// As many scans as wanted are open or done.
  [[nodiscard]] bool full() const { return closed_ || (most_scans_ > 0 && opened_ >= most_scans_); }
  /// Scans for which results may still come.
  [[nodiscard]] std::size_t open() const { return open_.size(); }
  /// Scans that any service has delivered.
  [[nodiscard]] std::uint64_t scans() const { return opened_; }
  /// What has not come by now is missing.
  void finish();

  /// All but the deployment and the duration.
  [[nodiscard]] ComparisonFigures figures() const;

 private:
  using OpenScan = std::vector<std::optional<CornerResult>>;  // by service
  struct Tally {
    std::string name;
    std::string methods;
    std::optional<ScanKey> first;
    std::optional<ScanKey> newest;
    std::uint64_t scans = 0;
    std::uint64_t missing = 0;
    std::uint64_t corners = 0;
    AgainstReference against;
    QuantileHistogram distance;
    QuantileHistogram sigma;
    QuantileHistogram ellipse_area;  // [mm^2]
    QuantileHistogram latency;
  };

  static void count(Tally& tally, const ScanKey& scan, const CornerResult& result);
  void compare(std::size_t service, const ScanKey& scan, CornerResult result);
  void compare(Tally& tally, const CornerResult& reference, const CornerResult& own) const;
  [[nodiscard]] bool is_complete(const ScanKey& scan, const OpenScan& results) const;
  void settle_oldest();

  const std::size_t reference_;
  const MatchingGate gate_;
  const std::uint64_t most_scans_;
  std::vector<Tally> tallies_;
  std::map<ScanKey, OpenScan> open_;
  std::optional<ScanKey> complete_through_;
  std::uint64_t opened_ = 0;
  bool closed_ = false;
};

}  // namespace quoin::deploy
