// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <optional>
#include <vector>

#include "sensor_bridge/rplidar/emulator/fault.hpp"

namespace quoin::sensor_bridge::rplidar {

/// Faults that are under way or still to come.
class FaultSchedule {
 public:
  using TimePoint = std::chrono::steady_clock::time_point;

  struct Entry {
    Fault fault;
    TimePoint begin;
    std::optional<TimePoint> end;
    bool begun = false;

    [[nodiscard]] bool active(TimePoint time) const {
      return time >= begin && (!end || time < *end);
    }
  };

  void add(const Fault& fault, TimePoint now);
  /// Ends all of them, also those to come.
  void clear() { entries_.clear(); }
  /// Ends those of this kind that are under way.
  void end(FaultKind kind, TimePoint time);

  /// The fault of this kind that was added last of those under way; nothing when none is.
  [[nodiscard]] const Entry* find(FaultKind kind, TimePoint time) const;
  /// Its value.
  [[nodiscard]] std::optional<double> value(FaultKind kind, TimePoint time) const;

  /// The next beginning or end after `time`.
  [[nodiscard]] std::optional<TimePoint> next_change(TimePoint time) const;
  /// Those that began by `time`, each once.
  [[nodiscard]] std::vector<Fault> take_begun(TimePoint time);
  /// Those that ended by `time`, which are forgotten.
  [[nodiscard]] std::vector<Fault> take_ended(TimePoint time);

 private:
  std::vector<Entry> entries_;
};

}  // namespace quoin::sensor_bridge::rplidar
