// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/topics/line_map.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/geometry/angle.hpp"

namespace quoin::topics {

namespace {

constexpr double same_place = 0.005;      // [m] of the ends
constexpr double same_direction = 0.001;  // [rad]
constexpr double same_stddev = 0.1;       // as a part of it

/// Whether who reads the one need not be sent the other.
bool about_same(const MapLine& a, const MapLine& b) {
  const auto known_alike = [](double before, double now) {
    return std::abs(std::sqrt(before) - std::sqrt(now)) <= same_stddev * std::sqrt(before);
  };
  return a.id == b.id && (a.start - b.start).norm() < same_place &&
         (a.end - b.end).norm() < same_place &&
         std::abs(normalized_angle(a.direction() - b.direction())) < same_direction &&
         known_alike(a.covariance(0, 0), b.covariance(0, 0)) &&
         known_alike(a.covariance(1, 1), b.covariance(1, 1));
}

bool finite(const msg::MapLine& line) {
  return std::isfinite(line.start().x()) && std::isfinite(line.start().y()) &&
         std::isfinite(line.end().x()) && std::isfinite(line.end().y()) &&
         std::isfinite(line.covariance_direction_offset()) && line.covariance_direction() >= 0.0 &&
         std::isfinite(line.covariance_direction()) && line.covariance_offset() >= 0.0 &&
         std::isfinite(line.covariance_offset());
}

}  // namespace

msg::MapLine map_line_message(const MapLine& line) {
  msg::MapLine message;
  message.id(line.id);
  message.start().x(line.start.x());
  message.start().y(line.start.y());
  message.end().x(line.end.x());
  message.end().y(line.end.y());
  message.covariance_direction(line.covariance(0, 0));
  message.covariance_direction_offset(line.covariance(0, 1));
  message.covariance_offset(line.covariance(1, 1));
  message.observations(static_cast<std::uint32_t>(
      std::min<std::size_t>(line.observations, std::numeric_limits<std::uint32_t>::max())));
  return message;
}

MapLine map_line(const msg::MapLine& message) {
  MapLine line;
  line.id = message.id();
  line.start = {message.start().x(), message.start().y()};
  line.end = {message.end().x(), message.end().y()};
  line.covariance << message.covariance_direction(), message.covariance_direction_offset(),
      message.covariance_direction_offset(), message.covariance_offset();
  line.observations = message.observations();
  return line;
}

std::size_t PublishedLineMap::update(std::span<const MapLine> lines) {
  std::size_t beyond = 0;
  for (auto& part : sorted_) part.clear();
  for (const MapLine& line : lines) {
    if (line.id >= most_walls) {
      ++beyond;
      continue;
    }
    const auto part = static_cast<std::size_t>(line.id / walls_of_a_part);
    if (part >= sorted_.size()) sorted_.resize(part + 1);
    sorted_[part].push_back(line);
  }
  bool changed = false;
  if (parts_.size() < sorted_.size()) {
    // All say how many parts there are.
    for (Part& part : parts_) part.differs = true;
    parts_.resize(sorted_.size());
    changed = true;
  }
  for (std::size_t i = 0; i < sorted_.size(); ++i) {
    std::ranges::sort(sorted_[i], {}, &MapLine::id);
    if (std::ranges::equal(sorted_[i], parts_[i].lines, about_same)) continue;
    parts_[i].lines = sorted_[i];
    parts_[i].differs = true;
    changed = true;
  }
  if (changed) ++version_;
  return beyond;
}

bool PublishedLineMap::next(msg::LineMap& out) {
  const auto part = std::ranges::find(parts_, true, &Part::differs);
  if (part == parts_.end()) return false;
  part->differs = false;
  out.part(static_cast<std::uint32_t>(part - parts_.begin()));
  out.parts(static_cast<std::uint32_t>(parts_.size()));
  out.begun(begun_);
  out.version(version_);
  out.lines().clear();
  for (const MapLine& line : part->lines) out.lines().push_back(map_line_message(line));
  return true;
}

bool ReceivedLineMap::take(const msg::LineMap& message) {
  if (message.parts() > most_parts || message.part() >= message.parts() ||
      message.lines().size() > walls_of_a_part ||
      !std::ranges::all_of(message.lines(), [&](const msg::MapLine& line) {
        return line.id() / walls_of_a_part == message.part() && finite(line);
      })) {
    return false;
  }
  if (message.begun() < begun_) return false;
  if (message.begun() > begun_) {
    *this = ReceivedLineMap();
    begun_ = message.begun();
  }
  Part& part = parts_[message.part()];
  if (message.version() < part.version) return false;
  part.version = message.version();
  part.lines.clear();
  for (const msg::MapLine& line : message.lines()) part.lines.push_back(map_line(line));
  if (message.version() >= version_) {
    version_ = message.version();
    wanted_ = message.parts();
  }
  return true;
}

std::vector<MapLine> ReceivedLineMap::lines() const {
  std::vector<MapLine> all;
  for (const auto& [number, part] : parts_) {
    all.insert(all.end(), part.lines.begin(), part.lines.end());
  }
  return all;
}

}  // namespace quoin::topics
