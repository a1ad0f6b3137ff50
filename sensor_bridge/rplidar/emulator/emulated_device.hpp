// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/simulation/random.hpp"
#include "core/simulation/world.hpp"
#include "sensor_bridge/rplidar/emulator/device_identity.hpp"
#include "sensor_bridge/rplidar/emulator/emulator_settings.hpp"
#include "sensor_bridge/rplidar/emulator/fault_schedule.hpp"
#include "sensor_bridge/rplidar/emulator/garbler.hpp"
#include "sensor_bridge/rplidar/emulator/motor.hpp"
#include "sensor_bridge/rplidar/emulator/range_finder.hpp"
#include "sensor_bridge/rplidar/emulator/transmitter.hpp"
#include "sensor_bridge/rplidar/protocol/descriptor.hpp"
#include "sensor_bridge/rplidar/protocol/request.hpp"
#include "sensor_bridge/rplidar/protocol/sample_encoder.hpp"

namespace quoin::sensor_bridge::rplidar {

enum class DeviceState { unplugged, resetting, idle, spinning_up, scanning, protection_stop };

/// "scanning".
[[nodiscard]] std::string_view state_name(DeviceState state);

/// What a device did since it was made.
struct DeviceCounts {
  std::uint64_t requests = 0;         ///< understood
  std::uint64_t checksum_errors = 0;  ///< requests that were not
  std::uint64_t resets = 0;           ///< by request or by being plugged in
  std::uint64_t frames = 0;           ///< of measurements
  std::uint64_t faulty_frames = 0;    ///< that a fault lost, repeated or made late
  std::uint64_t lost_bytes = 0;       ///< for which the serial line was too slow
};

/// A device that measures in a simulated world and talks as an RPLIDAR does, byte by byte. It
/// has no clock, no input and no output of its own: the same calls give the same bytes. Times never
/// go back from one call to the next.
class EmulatedDevice {
 public:
  using TimePoint = std::chrono::steady_clock::time_point;
  /// Called for each event, with its time.
  using Report = std::function<void(TimePoint, const std::string&)>;

  /// Plugged in and ready at `now`. Throws std::invalid_argument for settings that cannot be.
  EmulatedDevice(const EmulatorSettings& settings, World world, TimePoint now, Report report = {});

  /// What arrives from the client at `now`.
  void receive(std::span<const std::uint8_t> bytes, TimePoint now);

  /// Appends what has left the device's serial line by `now`.
  void send(TimePoint now, std::vector<std::uint8_t>& out);

  /// When the next bytes will have left or the device will change on its own; nothing while it only
  /// waits for requests.
  [[nodiscard]] std::optional<TimePoint> next_event() const;

  void apply(const Fault& fault, TimePoint now);
  /// Ends all faults, also those to come.
  void clear_faults(TimePoint now);

  [[nodiscard]] DeviceState state() const { return state_; }
  [[nodiscard]] double motor_speed(TimePoint now) const { return motor_.speed(now); }  ///< [rev/s]
  [[nodiscard]] DeviceCounts counts() const;
  [[nodiscard]] const DeviceIdentity& identity() const { return identity_; }
  /// Acquisition of the sample with this number of the scan under way.
  [[nodiscard]] TimePoint sample_time(std::uint64_t index) const;
  /// What the motor's angle truly is, turns since the start.
  [[nodiscard]] double turns(TimePoint time) const { return motor_.turns(time); }

 private:
  void advance(TimePoint now);
  [[nodiscard]] std::optional<TimePoint> next_change() const;
  void change(TimePoint now);
  void change_faults(TimePoint now);

  void carry_out(const Request& request, TimePoint now);
  void answer(AnswerType type, std::span<const std::uint8_t> payload, TimePoint now);
  void start_scan(std::size_t mode, bool wait_for_speed, TimePoint now);
  void stop_scan(TimePoint now);
  void set_speed(std::span<const std::uint8_t> payload, TimePoint now);
  void set_pwm(std::span<const std::uint8_t> payload, TimePoint now);
  void reset(TimePoint now);
  void enter(DeviceState state, TimePoint now);
  void drive_motor(TimePoint now);

  void begin_samples(TimePoint now);
  [[nodiscard]] std::size_t samples_for_frame() const;
  void sample_until(TimePoint now);
  [[nodiscard]] double direction_of_ray(double angle, TimePoint time) const;
  void send_frame(TimePoint now);
  void send_with_losses(TimePoint now);
  void announce(std::uint32_t length, bool repeated, std::uint8_t type, TimePoint now);
  void transmit(std::span<const std::uint8_t> bytes, TimePoint now);
  [[nodiscard]] bool misbehaves(FaultKind kind, TimePoint now) const {
    return faults_.find(kind, now) != nullptr;
  }
  void report(TimePoint now, const std::string& what) const {
    if (report_) report_(now, what);
  }

  EmulatorSettings settings_;
  DeviceIdentity identity_;
  RangeFinder range_finder_;
  Motor motor_;
  Transmitter transmitter_;
  FaultSchedule faults_;
  Garbler garbler_;
  Random damage_;
  Report report_;
  RequestScanner requests_;
  DeviceState state_ = DeviceState::idle;
  DeviceCounts counts_;
  TimePoint advanced_to_;
  TimePoint reset_until_;
  double speed_;                   // [rev/s] that the client wants
  unsigned pwm_ = 0;               // of an accessory board
  std::int64_t resets_to_go_ = 0;  // until the error of its health is gone

  // Of the scan under way.
  std::size_t mode_ = 0;
  std::optional<SampleEncoder> encoder_;
  TimePoint first_sample_;
  std::uint64_t samples_ = 0;
  std::vector<Sample> frame_;
  std::vector<std::uint8_t> bytes_;
  std::vector<std::uint8_t> late_frame_;  // that goes behind the next one
  std::optional<SampleEncoder> second_encoder_;
  std::vector<Sample> second_frame_;
};

}  // namespace quoin::sensor_bridge::rplidar
