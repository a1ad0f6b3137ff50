// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "sensor_bridge/rplidar/driver/diagnosis.hpp"
#include "sensor_bridge/rplidar/driver/driver_settings.hpp"
#include "sensor_bridge/rplidar/driver/interruption.hpp"
#include "sensor_bridge/rplidar/protocol/descriptor.hpp"
#include "sensor_bridge/rplidar/protocol/device_info.hpp"
#include "sensor_bridge/rplidar/protocol/request.hpp"
#include "sensor_bridge/transport/transport.hpp"

namespace quoin::sensor_bridge::rplidar {

/// Asks a device and reads what it says. Answers may stand behind measurements that were under way;
/// these are passed over. Throws DeviceError, TransportError, or Stopped.
class Client {
 public:
  /// `name` of the endpoint for messages. Transport and interruption must outlive the client.
  Client(Transport& transport, const Interruption& interruption, const TimeOuts& time_outs,
         std::string name);

  /// Ends a scan and reads on until the device is quiet; false when it never became so.
  bool stop();
  /// Starts the device anew and waits until it takes requests.
  void reset();

  [[nodiscard]] DeviceInfo info(TimeOuts::Time time_out);
  [[nodiscard]] DeviceHealth health();
  [[nodiscard]] SampleTimes sample_times();
  [[nodiscard]] std::vector<std::uint8_t> configuration(
      ConfigurationKey key, std::optional<std::uint16_t> mode = std::nullopt);

  /// Whether there is an accessory board that drives the motor by PWM.
  [[nodiscard]] bool has_motor_pwm();

  void set_motor_pwm(std::uint16_t pwm);
  /// In revolutions per minute.
  void set_motor_speed(std::uint16_t speed);
  void hold_motor(bool hold) { transport_.hold_motor(hold); }

  /// What the device announces to send from now on. Standard scans have a command of their own.
  [[nodiscard]] Descriptor start_scan(const ScanMode& mode);

  /// What has arrived, within the deadline; empty otherwise. Valid until the next call.
  [[nodiscard]] std::span<const std::uint8_t> read(Deadline deadline);

  /// All bytes that have arrived so far, of whatever meaning.
  [[nodiscard]] std::uint64_t received_bytes() const { return received_bytes_; }

 private:
  void send(const Request& request);
  [[nodiscard]] std::vector<std::uint8_t> ask(const Request& request, AnswerType type,
                                              TimeOuts::Time time_out);
  [[nodiscard]] std::vector<std::uint8_t> read_payload(std::size_t length, Deadline deadline);
  [[nodiscard]] Diagnosis no_answer(const Request& request, AnswerType type) const;

  Transport& transport_;
  const Interruption& interruption_;
  TimeOuts time_outs_;
  std::string name_;
  std::array<std::uint8_t, 4096> buffer_;
  std::span<const std::uint8_t> rest_;  // of the buffer, not yet read by anybody
  std::vector<std::uint8_t> heard_;     // the first bytes behind a request, for the diagnosis
  Deadline next_question_{};            // whether to stop
  std::uint64_t received_bytes_ = 0;
};

}  // namespace quoin::sensor_bridge::rplidar
