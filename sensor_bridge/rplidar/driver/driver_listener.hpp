// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "sensor_bridge/rplidar/driver/device_facts.hpp"
#include "sensor_bridge/rplidar/driver/diagnosis.hpp"
#include "sensor_bridge/rplidar/protocol/revolution.hpp"

namespace quoin::sensor_bridge::rplidar {

enum class DriverState {
  connecting,  ///< looks for the device
  starting,    ///< the motor spins up
  measuring,
  standby,     ///< the motor is stopped, as nobody wants the measurements
  recovering,  ///< something went wrong with the measurements
  waiting,     ///< until the next attempt to connect
  stopped,
};

/// Such as "measuring".
[[nodiscard]] std::string_view name_of(DriverState state);

/// What a driver has been through since it was made.
struct DriverCounts {
  std::uint64_t connections = 0;
  std::uint64_t revolutions = 0;
  std::uint64_t samples = 0;       ///< of these revolutions
  std::uint64_t lost_samples = 0;  ///< that are missing in these revolutions or between them
  std::uint64_t checksum_errors = 0;
  std::uint64_t skipped_bytes = 0;  ///< passed over in search of measurements
  std::uint64_t out_of_line = 0;    ///< frames that fit none before them
  std::uint64_t repeated = 0;       ///< frames that came twice, and were dropped
  double sample_period = 0.0;       ///< [s] as measured; 0 until it is known
  std::uint64_t resets = 0;         ///< of the device by this driver
  std::array<std::uint64_t, finding_count> recoveries{};  ///< by what made them necessary

  [[nodiscard]] std::uint64_t recoveries_from(Finding finding) const {
    return recoveries[static_cast<std::size_t>(finding)];
  }
};

/// Receives the events of a driver, in the thread that runs it. What it throws ends the run, with
/// the motor stopped.
class DriverListener {
 public:
  virtual ~DriverListener() = default;

  /// Whether anybody wants the revolutions; asked often.
  [[nodiscard]] virtual bool is_wanted() { return true; }
  virtual void state_changed(DriverState /*state*/) {}
  /// Before each first scan on a connection.
  virtual void connected(const DeviceFacts& facts, const ScanPlan& plan) = 0;
  /// Valid during the call only. `mode` is what the device sends in, and may be another than that
  /// of the plan.
  virtual void revolution(const Revolution& revolution, const ScanMode& mode) = 0;
  /// One that lasts is reported once until there are measurements again.
  virtual void problem(const Diagnosis& diagnosis) = 0;
};

}  // namespace quoin::sensor_bridge::rplidar
