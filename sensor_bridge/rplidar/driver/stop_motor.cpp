// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "sensor_bridge/rplidar/driver/stop_motor.hpp"

#include <array>
#include <chrono>
#include <thread>

#include "sensor_bridge/rplidar/protocol/request.hpp"

namespace quoin::sensor_bridge::rplidar {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

}  // namespace

void stop_motor(Transport& transport, std::optional<MotorControl> control) noexcept {
  const Deadline deadline = Clock::now() + 300ms;
  std::array<std::uint8_t, 4096> bytes;
  try {
    do {
      transport.write(Request(Command::stop).bytes(), deadline);
      std::this_thread::sleep_for(10ms);  // a device takes no request within 1 ms of a stop
      if (control.value_or(MotorControl::speed) == MotorControl::speed) {
        transport.write(motor_speed_request(0).bytes(), deadline);
      }
      if (control.value_or(MotorControl::pwm) == MotorControl::pwm) {
        transport.write(motor_pwm_request(0).bytes(), deadline);
      }
      if (control == MotorControl::line) transport.hold_motor(true);
      transport.discard_input();
      // What still comes was sent before, or the device has missed the words.
    } while (transport.read(bytes, Clock::now() + 30ms) > 0 && Clock::now() < deadline);
  } catch (const std::exception&) {
    return;
  }
}

}  // namespace quoin::sensor_bridge::rplidar
