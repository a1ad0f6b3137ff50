// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "deploy/observation/comparison.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace quoin::deploy {

namespace {

// Scans that wait for a service that lags behind; one that is further behind has missed them.
constexpr std::size_t most_open = 64;

}  // namespace

Comparison::Comparison(const std::vector<std::string>& services, std::size_t reference,
                       const MatchingGate& gate, std::uint64_t most_scans)
    : reference_(reference), gate_(gate), most_scans_(most_scans), tallies_(services.size()) {
  for (std::size_t i = 0; i < services.size(); ++i) tallies_[i].name = services[i];
}

void Comparison::add(std::size_t service, const ScanKey& scan, CornerResult result) {
  Tally& tally = tallies_[service];
  if (tally.newest && scan <= *tally.newest) return;  // the same again
  tally.newest = scan;
  if (complete_through_ && scan <= *complete_through_) {
    if (tally.missing > 0) --tally.missing;  // late, but there
    count(tally, scan, result);
  } else if (open_.contains(scan) || !full()) {
    count(tally, scan, result);
    compare(service, scan, std::move(result));
  }
  while (!open_.empty() &&
         (open_.size() > most_open || is_complete(open_.begin()->first, open_.begin()->second))) {
    settle_oldest();
  }
}

void Comparison::compare(std::size_t service, const ScanKey& scan, CornerResult result) {
  const auto [position, opened] = open_.try_emplace(scan, tallies_.size());
  if (opened) ++opened_;
  OpenScan& results = position->second;
  results[service] = std::move(result);
  const std::optional<CornerResult>& reference = results[reference_];
  if (!reference) return;
  for (std::size_t i = 0; i < results.size(); ++i) {
    const bool is_new = service == reference_ || i == service;
    if (i != reference_ && is_new && results[i]) compare(tallies_[i], *reference, *results[i]);
  }
}

void Comparison::count(Tally& tally, const ScanKey& scan, const CornerResult& result) {
  if (!tally.first) tally.first = scan;
  tally.methods = result.methods;
  ++tally.scans;
  tally.corners += result.corners.size();
  tally.latency.add(result.latency);
  for (const CornerEstimate& corner : result.corners) {
    tally.sigma.add(std::sqrt(0.5 * corner.covariance.trace()));
    // In mm^2: the histogram ends at 1e-9, which good corners come near to in m^2.
    tally.ellipse_area.add(one_sigma_ellipse_area(corner.covariance) * 1e6);
  }
}

void Comparison::compare(Tally& tally, const CornerResult& reference,
                         const CornerResult& own) const {
  ++tally.against.scans;
  tally.against.reference_corners += reference.corners.size();
  tally.against.own_corners += own.corners.size();
  for (const CornerMatch& match : match_corners(reference.corners, own.corners, gate_)) {
    ++tally.against.matched;
    tally.distance.add(match.distance);
  }
}

bool Comparison::is_complete(const ScanKey& scan, const OpenScan& results) const {
  for (std::size_t i = 0; i < results.size(); ++i) {
    const bool passed_by = tallies_[i].newest && *tallies_[i].newest > scan;
    if (!results[i] && !passed_by) return false;
  }
  return true;
}

void Comparison::settle_oldest() {
  const auto& [scan, results] = *open_.begin();
  for (std::size_t i = 0; i < results.size(); ++i) {
    Tally& tally = tallies_[i];
    const bool listened = !tally.first || *tally.first < scan;
    if (!results[i] && listened) ++tally.missing;
  }
  complete_through_ = scan;
  open_.erase(open_.begin());
}

void Comparison::finish() {
  close();
  while (!open_.empty()) settle_oldest();
}

ComparisonFigures Comparison::figures() const {
  ComparisonFigures figures;
  figures.scans = opened_;
  figures.reference = reference_;
  for (const Tally& tally : tallies_) {
    ComparedService service;
    service.name = tally.name;
    service.methods = tally.methods;
    service.scans = tally.scans;
    service.missing = tally.missing;
    if (tally.scans > 0) {
      service.mean_corners = static_cast<double>(tally.corners) / static_cast<double>(tally.scans);
    }
    service.median_sigma = tally.sigma.quantile(0.5);
    service.median_ellipse_area = tally.ellipse_area.quantile(0.5) * 1e-6;
    service.latency_p50 = tally.latency.quantile(0.5);
    service.latency_p99 = tally.latency.quantile(0.99);
    service.against = tally.against;
    service.against.median_distance = tally.distance.quantile(0.5);
    service.against.distance_p95 = tally.distance.quantile(0.95);
    figures.services.push_back(std::move(service));
  }
  return figures;
}

}  // namespace quoin::deploy
