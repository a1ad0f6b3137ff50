// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "sensor_bridge/rplidar/emulator/fault_schedule.hpp"

#include <algorithm>

#include "sensor_bridge/rplidar/emulator/seconds.hpp"

namespace quoin::sensor_bridge::rplidar {

void FaultSchedule::add(const Fault& fault, TimePoint now) {
  Entry entry{fault, now + duration_of(fault.begin), std::nullopt};
  if (fault.duration) entry.end = entry.begin + duration_of(*fault.duration);
  entries_.push_back(entry);
}

void FaultSchedule::end(FaultKind kind, TimePoint time) {
  std::erase_if(entries_,
                [&](const Entry& entry) { return entry.fault.kind == kind && entry.active(time); });
}

const FaultSchedule::Entry* FaultSchedule::find(FaultKind kind, TimePoint time) const {
  const auto found = std::find_if(entries_.rbegin(), entries_.rend(), [&](const Entry& entry) {
    return entry.fault.kind == kind && entry.active(time);
  });
  return found == entries_.rend() ? nullptr : &*found;
}

std::optional<double> FaultSchedule::value(FaultKind kind, TimePoint time) const {
  const Entry* entry = find(kind, time);
  if (entry == nullptr) return std::nullopt;
  return entry->fault.value;
}

std::optional<FaultSchedule::TimePoint> FaultSchedule::next_change(TimePoint time) const {
  std::optional<TimePoint> next;
  const auto consider = [&](TimePoint change) {
    if (change > time && (!next || change < *next)) next = change;
  };
  for (const Entry& entry : entries_) {
    consider(entry.begin);
    if (entry.end) consider(*entry.end);
  }
  return next;
}

std::vector<Fault> FaultSchedule::take_begun(TimePoint time) {
  std::vector<Fault> faults;
  for (Entry& entry : entries_) {
    if (entry.begun || entry.begin > time) continue;
    entry.begun = true;
    faults.push_back(entry.fault);
  }
  return faults;
}

std::vector<Fault> FaultSchedule::take_ended(TimePoint time) {
  std::vector<Fault> faults;
  std::erase_if(entries_, [&](const Entry& entry) {
    const bool ended = entry.end && *entry.end <= time;
    if (ended) faults.push_back(entry.fault);
    return ended;
  });
  return faults;
}

}  // namespace quoin::sensor_bridge::rplidar
