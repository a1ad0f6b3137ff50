// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "sensor_bridge/rplidar/driver/diagnosis.hpp"

#include <array>

namespace quoin::sensor_bridge::rplidar {
namespace {

constexpr std::array<std::string_view, finding_count> names{
    "fine",
    "no-such-port",
    "no-permission",
    "busy",
    "not-a-serial-port",
    "unsupported-baud-rate",
    "unknown-host",
    "refused",
    "unreachable",
    "connection-timed-out",
    "unplugged",
    "transport-failed",
    "no-bytes",
    "no-answer",
    "echo",
    "garbage",
    "wrong-length",
    "wrong-value",
    "other-baud-rate",
    "unknown-model",
    "health-warning",
    "protection-stop",
    "scan-not-started",
    "unknown-scan-mode",
    "speed-out-of-range",
    "silence",
    "damaged-frames",
    "no-frames",
    "other-format",
    "wrong-rotation",
    "no-revolution",
    "impossible-rotation",
    "mixed-frames",
    "line-too-slow",
};

Finding finding_of(TransportError::Kind kind) {
  switch (kind) {
    case TransportError::Kind::no_such_port:
      return Finding::no_such_port;
    case TransportError::Kind::no_permission:
      return Finding::no_permission;
    case TransportError::Kind::busy:
      return Finding::busy;
    case TransportError::Kind::not_a_serial_port:
      return Finding::not_a_serial_port;
    case TransportError::Kind::unsupported_baud_rate:
      return Finding::unsupported_baud_rate;
    case TransportError::Kind::unknown_host:
      return Finding::unknown_host;
    case TransportError::Kind::refused:
      return Finding::refused;
    case TransportError::Kind::unreachable:
      return Finding::unreachable;
    case TransportError::Kind::timed_out:
      return Finding::connection_timed_out;
    case TransportError::Kind::closed:
      return Finding::unplugged;
    case TransportError::Kind::failed:
      break;
  }
  return Finding::transport_failed;
}

}  // namespace

std::string_view name_of(Finding finding) { return names[static_cast<std::size_t>(finding)]; }

std::string to_text(const Diagnosis& diagnosis) {
  return diagnosis.advice.empty() ? diagnosis.text : diagnosis.text + "; " + diagnosis.advice;
}

Diagnosis diagnosis_of(const TransportError& error) {
  return {.finding = finding_of(error.kind()),
          .text = error.problem(),
          .advice = way_out(error.kind())};
}

}  // namespace quoin::sensor_bridge::rplidar
