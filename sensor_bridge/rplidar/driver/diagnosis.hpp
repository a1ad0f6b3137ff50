// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>

#include "sensor_bridge/transport/transport_error.hpp"

namespace quoin::sensor_bridge::rplidar {

/// What is the matter with a device, or nothing.
enum class Finding {
  fine,
  // The way to the device.
  no_such_port,
  no_permission,
  busy,
  not_a_serial_port,
  unsupported_baud_rate,
  unknown_host,
  refused,
  unreachable,
  connection_timed_out,
  unplugged,
  transport_failed,
  // Its answers.
  no_bytes,         ///< nothing arrives
  no_answer,        ///< to one question, though bytes had arrived before
  echo,             ///< what is sent comes back
  garbage,          ///< bytes arrive that are no answer
  wrong_length,     ///< an answer of a length that it never has
  wrong_value,      ///< an answer that cannot be meant
  other_baud_rate,  ///< it answers, at another rate than was asked for
  unknown_model,
  // Its state.
  health_warning,
  protection_stop,
  scan_not_started,  ///< no measurements were announced
  unknown_scan_mode,
  speed_out_of_range,
  // Its measurements.
  silence,
  damaged_frames,
  no_frames,            ///< bytes arrive in which there are no frames
  other_format,         ///< another than the one that was asked for; read all the same
  wrong_rotation,       ///< it turns at another speed than was asked for
  no_revolution,        ///< it measures, but does not turn
  impossible_rotation,  ///< the angles turn at a speed that no device has
  mixed_frames,         ///< frames that cannot be of one device
  line_too_slow,        ///< the serial line carries less than the scan mode sends
};

inline constexpr int finding_count = static_cast<int>(Finding::line_too_slow) + 1;

/// Such as "no-such-port"; the same in all versions.
[[nodiscard]] std::string_view name_of(Finding finding);

struct Diagnosis {
  Finding finding = Finding::fine;
  std::string text;    ///< what was seen, and where
  std::string advice;  ///< the way out; may be empty
};

/// In one line.
[[nodiscard]] std::string to_text(const Diagnosis& diagnosis);

[[nodiscard]] Diagnosis diagnosis_of(const TransportError& error);

/// The device cannot be used for now.
class DeviceError : public std::runtime_error {
 public:
  explicit DeviceError(Diagnosis diagnosis)
      : std::runtime_error(to_text(diagnosis)), diagnosis_(std::move(diagnosis)) {}

  [[nodiscard]] const Diagnosis& diagnosis() const { return diagnosis_; }

 private:
  Diagnosis diagnosis_;
};

/// The device cannot do what the settings ask for, however often it is tried.
class SettingsError : public DeviceError {
 public:
  using DeviceError::DeviceError;
};

}  // namespace quoin::sensor_bridge::rplidar
