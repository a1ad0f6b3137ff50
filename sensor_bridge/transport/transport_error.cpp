// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "sensor_bridge/transport/transport_error.hpp"

#include <cerrno>
#include <system_error>

namespace quoin::sensor_bridge {
namespace {

using Kind = TransportError::Kind;

Kind kind_of(int error) {
  switch (error) {
    case ENOENT:
    case ENODEV:
    case ENOTDIR:
      return Kind::no_such_port;
    case EACCES:
    case EPERM:
      return Kind::no_permission;
    case EBUSY:
    case EWOULDBLOCK:
      return Kind::busy;
    case ENOTTY:
    case EISDIR:
      return Kind::not_a_serial_port;
    case ECONNREFUSED:
      return Kind::refused;
    case EHOSTUNREACH:
    case ENETUNREACH:
    case EHOSTDOWN:
    case ENETDOWN:
    case EADDRNOTAVAIL:
      return Kind::unreachable;
    case ETIMEDOUT:
      return Kind::timed_out;
    case EIO:  // what a port says after it was unplugged
    case ENXIO:
    case ECONNRESET:
    case ECONNABORTED:
    case EPIPE:
      return Kind::closed;
    default:
      return Kind::failed;
  }
}

std::string joined(const std::string& problem, const std::string& advice) {
  return advice.empty() ? problem : problem + "; " + advice;
}

}  // namespace

std::string way_out(TransportError::Kind kind) {
  switch (kind) {
    case Kind::no_such_port:
      return "is the cable plugged in? quoin lidar list shows the ports that are there";
    case Kind::no_permission:
      return "add the user to the port's group (sudo usermod -aG dialout $USER, then log in "
             "again) or install the udev rule";
    case Kind::busy:
      return "end the other program that uses it";
    case Kind::not_a_serial_port:
      return "name a serial port such as /dev/ttyUSB0";
    case Kind::unsupported_baud_rate:
      return "choose another baud rate or another adapter";
    case Kind::unknown_host:
      return "check the spelling or write the address";
    case Kind::refused:
      return "check the port number and the device's power";
    case Kind::unreachable:
      return "check the address, the network cable and this computer's own address";
    case Kind::timed_out:
      return "check the address, the cable and the device's power";
    case Kind::closed:
      return "plug it in again; check the cable and the power";
    case Kind::failed:
      break;
  }
  return "";
}

TransportError::TransportError(Kind kind, const std::string& problem)
    : std::runtime_error(joined(problem, way_out(kind))), kind_(kind), problem_(problem) {}

TransportError system_error(const std::string& endpoint, const std::string& operation, int error) {
  return {kind_of(error),
          endpoint + ": cannot " + operation + ": " + std::system_category().message(error)};
}

}  // namespace quoin::sensor_bridge
