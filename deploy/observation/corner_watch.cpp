// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "deploy/observation/corner_watch.hpp"

#include <algorithm>
#include <cmath>

#include "services/runtime/dds/qos.hpp"
#include "services/topics/header.hpp"

namespace quoin::deploy {

CornerWatch::CornerWatch(runtime::Participant& participant, const Deployment& deployment,
                         const ServiceConfig& service, bool joined_late)
    : name_(service.name),
      reader_(participant, output_topic(deployment, service), runtime::output_qos(service)),
      joined_late_(joined_late) {}

bool CornerWatch::take_all(const std::function<void(const msg::Header&)>& on_scan) {
  bool any = false;
  while (reader_.take(message_)) {
    any = true;
    const std::uint64_t received = accounting_.received();
    accounting_.receive(message_.header());
    if (accounting_.received() == received) continue;  // the same scan again
    if (received == 0 && !joined_late_) first_number_ = topics::sequence_number(message_.header());
    add(message_);
    on_scan(message_.header());
  }
  return any;
}

void CornerWatch::add(const msg::Corners& message) {
  if (!message.header().trace().empty()) source_trace_ = message.header().trace()[0];
  corners_ += message.corners().size();
  for (const msg::Corner& corner : message.corners()) {
    sigma_.add(std::sqrt(0.5 * (corner.covariance_xx() + corner.covariance_yy())));
    // In mm^2: the histogram ends at 1e-9, which good corners come near to in m^2.
    ellipse_area_.add(corner.ellipse_area() * 1e6);
  }
}

void CornerWatch::interrupt() {
  accounting_.interrupt();
  if (heard_nothing()) joined_late_ = true;
}

std::uint64_t CornerWatch::lost_at_start(const std::vector<SourceInstance>& instances) const {
  if (joined_late_ || (heard_nothing() && !ended_)) return 0;
  std::uint64_t lost = first_number_;
  for (const SourceInstance& instance : instances) {
    if (heard_nothing()) {
      if (instance.service == source_) lost = std::max(lost, instance.ledger.scans());
    } else if (instance.ledger.knows(sources().front().incarnation)) {
      lost += instance.ledger.scans_before(sources().front().incarnation);
    }
  }
  return lost;
}

CornerFigures CornerWatch::figures(const std::vector<SourceInstance>& instances) const {
  CornerFigures figures;
  figures.name = name_;
  figures.scans_delivered = accounting_.received();
  figures.lost_by_stage = accounting_.lost_by_stage();
  std::uint64_t unsettled = 0;
  for (const SourceInstance& instance : instances) {
    unsettled += instance.ledger.unsettled(sources(), ended_);
  }
  if (unsettled > 0) figures.lost_by_stage["end"] += unsettled;
  if (const std::uint64_t lost = lost_at_start(instances); lost > 0) {
    figures.lost_by_stage["start"] += lost;
  }
  for (const auto& [stage, count] : figures.lost_by_stage) figures.scans_lost += count;
  figures.scans_expected = figures.scans_delivered + figures.scans_lost;
  if (figures.scans_delivered > 0) {
    figures.mean_corners =
        static_cast<double>(corners_) / static_cast<double>(figures.scans_delivered);
  }
  figures.median_sigma = sigma_.quantile(0.5);
  figures.median_ellipse_area = ellipse_area_.quantile(0.5) * 1e-6;
  return figures;
}

}  // namespace quoin::deploy
