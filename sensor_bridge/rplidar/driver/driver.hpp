// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sensor_bridge/rplidar/driver/connection.hpp"
#include "sensor_bridge/rplidar/driver/driver_listener.hpp"
#include "sensor_bridge/rplidar/driver/driver_settings.hpp"

namespace quoin::sensor_bridge::rplidar {

/// Runs one device: finds it, makes it measure, and whatever happens to it brings it back.
class Driver {
 public:
  /// `open` is for tests; without it the settings decide. The listener must outlive it.
  Driver(DriverSettings settings, DriverListener& listener, Opener open = {});

  /// Returns when interrupted. The motor is stopped by whatever way it ends. Throws SettingsError
  /// when the device says twice that it has no such scan mode or speed, and what the listener
  /// throws.
  void run(const Interruption& interruption);

  /// For the thread that runs it, as in calls of the listener.
  [[nodiscard]] const DriverCounts& counts() const { return counts_; }

 private:
  /// Returns what it ended with.
  [[nodiscard]] Finding attempt(const Interruption& interruption);
  void run_connection(const Interruption& interruption);
  void leave_protection_stop(Client& client, DeviceHealth& health);
  [[nodiscard]] bool reset(Client& client);
  [[nodiscard]] Diagnosis scan(Client& client, const DeviceFacts& facts, const ScanPlan& plan,
                               const Interruption& interruption);
  /// Returns what it ended with: fine when nobody wants the revolutions.
  [[nodiscard]] Diagnosis measure(Client& client, const DeviceFacts& facts, const ScanPlan& plan,
                                  const ScanMode& announced);
  [[nodiscard]] ScanMode mode_of(SampleFormat format, const DeviceFacts& facts,
                                 const ScanMode& wanted);
  void stand_by(const Connection& connection, Client& client, MotorControl motor);
  void start_motor(Client& client, MotorControl motor, const ScanPlan& plan,
                   const Interruption& interruption);
  void warn_of_line(const DeviceFacts& facts, const ScanMode& mode);
  void note_revolution(const Revolution& revolution, const ScanMode& mode);
  void wait_before_next_attempt(Finding failure, const Interruption& interruption);
  [[nodiscard]] std::vector<unsigned> baud_rates() const;
  [[nodiscard]] Connection find(const Interruption& interruption);

  void enter(DriverState state);
  void report(const Diagnosis& diagnosis);
  void recover_from(const Diagnosis& diagnosis);

  DriverSettings settings_;
  DriverListener& listener_;
  Opener open_;
  std::string name_;
  DriverCounts counts_;
  std::optional<DriverState> state_;
  std::optional<Finding> reported_;  // since there were measurements

  bool connected_ = false;
  unsigned known_baud_rate_ = 0;  // at which the device was last found
  int attempts_ = 0;              // in a row to which no device answered
  Deadline attempt_begin_{};
  int settings_errors_ = 0;  // in a row
  int failures_ = 0;         // of scans, in a row
  int resets_ = 0;           // in a row
  Deadline last_reset_{};
  TimeOuts::Time pause_;
};

}  // namespace quoin::sensor_bridge::rplidar
