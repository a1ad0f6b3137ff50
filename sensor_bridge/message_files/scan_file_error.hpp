// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stdexcept>

namespace quoin::sensor_bridge {

/// A scan file that cannot be read (any further): "file:line:column: what; what to do", or
/// "file: byte N: ..." where it is not text.
class ScanFileError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace quoin::sensor_bridge
