// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "deploy/observation/end_watch.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "services/topics/header.hpp"

namespace quoin::deploy {

namespace {

void count(const runtime::LossCounts& counts, LossFigures& figures) {
  for (const auto& [site, lost] : counts) {
    switch (site.place) {
      case runtime::LossPlace::service:
        figures.by_service[site.service] += lost;
        break;
      case runtime::LossPlace::link:
        figures.on_link += lost;
        break;
      case runtime::LossPlace::start:
        figures.at_start += lost;
        break;
      case runtime::LossPlace::end:
        figures.at_end += lost;
        break;
    }
  }
}

}  // namespace

void CornerStatistics::add(const msg::Corners& message) {
  corners_ += message.corners().size();
  for (const msg::Corner& corner : message.corners()) {
    sigma_.add(std::sqrt(0.5 * (corner.covariance_xx() + corner.covariance_yy())));
    // In mm^2: the histogram ends at 1e-9, which good corners come near to in m^2.
    ellipse_area_.add(corner.ellipse_area() * 1e6);
  }
}

CornerFigures CornerStatistics::figures(std::uint64_t scans) const {
  CornerFigures figures;
  if (scans > 0) figures.mean_corners = static_cast<double>(corners_) / static_cast<double>(scans);
  figures.median_sigma = sigma_.quantile(0.5);
  figures.median_ellipse_area = ellipse_area_.quantile(0.5) * 1e-6;
  return figures;
}

EndWatch::EndWatch(const Connection& end, std::string name, bool joined_late)
    : name_(std::move(name)),
      service_(end.writer->name),
      type_(end.type),
      joined_late_(joined_late),
      gives_corners_(end.type == "corners"),
      newest_counts_(effective_qos("", end.type) == "state") {}

namespace {

void add(const msg::Pose& message, PoseFigures& figures) {
  const bool tracking = message.status() == msg::PoseStatus::POSE_TRACKING;
  const bool ambiguous = message.status() == msg::PoseStatus::POSE_AMBIGUOUS;
  ++(tracking ? figures.tracking : ambiguous ? figures.ambiguous : figures.lost);
  figures.status = tracking ? "tracking" : ambiguous ? "ambiguous" : "lost";
  figures.x = message.pose().x();
  figures.y = message.pose().y();
  figures.theta = message.pose().theta();
}

MapFigures map_figures(const topics::ReceivedLineMap& map) {
  MapFigures figures;
  for (const MapLine& line : map.lines()) {
    ++figures.walls;
    figures.length += line.length();
  }
  return figures;
}

}  // namespace

bool EndWatch::receive(const msg::Header& header, const EndMessage& message) {
  if (newest_counts_) accounting_.interrupt();
  const std::uint64_t received = accounting_.received();
  accounting_.receive(header);
  if (accounting_.received() == received) return false;
  if (received == 0 && !joined_late_) first_number_ = topics::sequence_number(header);
  if (!header.trace().empty()) {
    source_trace_ = header.trace().front();
    latency_.add(
        static_cast<double>(header.trace().back().published() - source_trace_.published()) * 1e-9);
  }
  if (gives_corners_ && message.corners != nullptr) corners_.add(*message.corners);
  if (message.pose != nullptr) {
    if (!pose_) pose_.emplace();
    add(*message.pose, *pose_);
  }
  if (message.map != nullptr) {
    if (!map_) map_.emplace();
    (void)map_->take(*message.map);
  }
  return true;
}

void EndWatch::set_path(const std::vector<Connection>& path) {
  source_ = path.front().writer->name;
  source_type_ = path.front().output.type;
  topics_.clear();
  for (const Connection& step : path) topics_[step.writer->name] = step.output.topic;
}

std::string EndWatch::topic_of(const std::string& service) const {
  const auto found = topics_.find(service);
  return found == topics_.end() ? "" : found->second;
}

void EndWatch::interrupt() {
  accounting_.interrupt();
  if (heard_nothing()) joined_late_ = true;
}

std::uint64_t EndWatch::lost_at_start(const std::vector<SourceInstance>& instances) const {
  if (joined_late_ || (heard_nothing() && !ended_)) return 0;
  std::uint64_t lost = first_number_;
  for (const SourceInstance& instance : instances) {
    if (heard_nothing()) {
      if (instance.service == source_ && instance.type == source_type_) {
        lost = std::max(lost, instance.ledger.scans());
      }
    } else if (instance.type == source_type_ &&
               instance.ledger.knows(sources().front().incarnation)) {
      lost += instance.ledger.scans_before(sources().front().incarnation);
    }
  }
  return lost;
}

EndFigures EndWatch::figures(const std::vector<SourceInstance>& instances) const {
  EndFigures figures;
  figures.name = name_;
  figures.type = type_;
  figures.scans_delivered = accounting_.received();
  if (!newest_counts_) {
    count(accounting_.lost_by_site(), figures.lost);
    for (const SourceInstance& instance : instances) {
      if (instance.type != source_type_) continue;
      figures.lost.at_end += instance.ledger.unaccounted(sources(), ended_);
    }
    figures.lost.at_start += lost_at_start(instances);
  }
  figures.scans_expected = figures.scans_delivered + figures.lost.sum();
  figures.latency_p50 = latency_.quantile(0.5);
  figures.latency_p99 = latency_.quantile(0.99);
  if (gives_corners_) figures.corners = corners_.figures(figures.scans_delivered);
  figures.pose = pose_;
  if (map_) figures.map = map_figures(*map_);
  return figures;
}

}  // namespace quoin::deploy
