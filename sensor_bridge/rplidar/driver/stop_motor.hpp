// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <utility>

#include "sensor_bridge/rplidar/protocol/device_info.hpp"
#include "sensor_bridge/transport/transport.hpp"

namespace quoin::sensor_bridge::rplidar {

/// Ends whatever the device does and lets its motor idle: sends the request until it is quiet, a
/// few times at most. Takes less than 0.4 s, and fails without a word where nobody can be told any
/// more. Without a word on how the motor is driven it is told by every request; the line that holds
/// the motor is set for those only that are driven by it.
void stop_motor(Transport& transport, std::optional<MotorControl> control) noexcept;

/// An open transport to a device whose motor is stopped when this one's life ends, by whatever way.
class MotorGuard {
 public:
  explicit MotorGuard(std::unique_ptr<Transport> transport) : transport_(std::move(transport)) {}
  MotorGuard(MotorGuard&&) = default;
  MotorGuard& operator=(MotorGuard&&) = delete;
  ~MotorGuard() {
    if (transport_ && armed_) stop_motor(*transport_, control_);
  }

  /// Whether there is a device at the other end.
  void arm(bool armed) { armed_ = armed; }
  void driven_by(MotorControl control) { control_ = control; }
  [[nodiscard]] Transport& transport() const { return *transport_; }

 private:
  std::unique_ptr<Transport> transport_;
  bool armed_ = false;
  std::optional<MotorControl> control_;
};

}  // namespace quoin::sensor_bridge::rplidar
