// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stdexcept>
#include <string>

namespace quoin::sensor_bridge {

/// Why bytes cannot be exchanged with an endpoint. what() is the problem and the way out.
class TransportError : public std::runtime_error {
 public:
  enum class Kind {
    no_such_port,       ///< no such device file: not plugged in, or another name
    no_permission,      ///< the user may not open it
    busy,               ///< another program uses it
    not_a_serial_port,  ///< another kind of file
    unsupported_baud_rate,
    unknown_host,  ///< the name has no address
    refused,       ///< nothing listens there
    unreachable,   ///< no way to the host
    timed_out,     ///< no answer to the connection, or bytes that cannot be handed over
    closed,        ///< unplugged, or closed by the other end
    failed,        ///< anything else
  };

  /// `problem` names the endpoint and what is wrong with it.
  TransportError(Kind kind, const std::string& problem);

  [[nodiscard]] Kind kind() const { return kind_; }
  [[nodiscard]] const std::string& problem() const { return problem_; }

 private:
  Kind kind_;
  std::string problem_;
};

/// What the user can do; empty when there is nothing to advise.
[[nodiscard]] std::string way_out(TransportError::Kind kind);

/// What an operation on `endpoint` ended with; `error` is the value of errno, whose text is in the
/// message.
[[nodiscard]] TransportError system_error(const std::string& endpoint, const std::string& operation,
                                          int error);

}  // namespace quoin::sensor_bridge
