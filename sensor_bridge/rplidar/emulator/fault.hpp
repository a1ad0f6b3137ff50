// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace quoin::sensor_bridge::rplidar {

/// Ways in which an emulated device misbehaves.
enum class FaultKind {
  silence,           ///< nothing leaves the device
  garbage,           ///< all that it sends is damaged
  wrong_checksums,   ///< value: share of the measurement frames that are damaged
  dropped_bytes,     ///< value: share of the bytes that get lost
  flipped_bits,      ///< value: share of the bits that arrive inverted
  lost_frames,       ///< value: share of the measurement frames that get lost as a whole
  repeated_frames,   ///< value: share that is sent twice
  swapped_frames,    ///< value: share that changes places with the frame behind
  second_device,     ///< another device sends its frames on the same line, in between
  wrong_format,      ///< announces standard nodes, whatever it sends
  slow_spin_up,      ///< value: [s] from rest to 10 Hz
  health_error,      ///< protection stop; value: how many resets it takes to end it
  unplug,            ///< without power and connection
  speed,             ///< value: [Hz] at which the motor turns, whatever is set
  zero_sample_time,  ///< says that its samples take no time
  wrong_length,      ///< announces answers 3 bytes longer than they are
  long_answers,      ///< sends answers that are longer than known
  slow_answers,      ///< value: [s] from a request to its answer
  health_warning,    ///< value: error code of a warning
  unknown_model,     ///< reports an unknown model
  unknown_format,    ///< reports an unknown sample format
};

/// A misbehaviour with its time.
struct Fault {
  FaultKind kind = FaultKind::silence;
  double value = 0.0;              ///< meaning and unit depend on `kind`; 0 when it has none
  double begin = 0.0;              ///< [s] after it is applied
  std::optional<double> duration;  ///< [s]; endless when absent

  friend bool operator==(const Fault&, const Fault&) = default;
};

/// A text that describes no fault: what is wrong with which part, and what to write instead.
class FaultError : public std::invalid_argument {
 public:
  using std::invalid_argument::invalid_argument;
};

/// The words for all kinds of faults.
[[nodiscard]] std::vector<std::string> fault_names();

/// Faults separated by commas, each `name[=value][@begin][+duration]`, such as
/// `unplug@20s+5s, wrong_checksums=0.3@10s+2s`. Times have the unit s, ms or min. Without a
/// beginning it is at once, without a duration until the end. Throws FaultError.
[[nodiscard]] std::vector<Fault> parse_faults(std::string_view text);

/// One fault as it is typed: the same words, or with a space before the duration: `unplug 5s`.
/// Throws FaultError.
[[nodiscard]] Fault parse_typed_fault(std::string_view line);

/// In the form that parse_faults reads.
[[nodiscard]] std::string fault_text(const Fault& fault);

}  // namespace quoin::sensor_bridge::rplidar
