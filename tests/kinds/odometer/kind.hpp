// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <tuple>

#include "core/parameters/parameter.hpp"
#include "services/deployment/kind.hpp"

namespace quoin::tests {

struct OdometerParameters {
  double rate_hz = 10.0;   ///< [Hz] of the scans
  std::int64_t scans = 0;  ///< 0: endless

  static constexpr auto fields() {
    using P = OdometerParameters;
    return std::tuple{field(&P::rate_hz, "rate_hz", "Hz", 0.1, 1000.0, "scans a second"),
                      field(&P::scans, "scans", "", 0.0, 1e9, "scans before it ends")};
  }
};

/// Stands for a base that measures how it moves beside its LiDAR: lines come twice as often as
/// scans, and a quarter of a revolution beside their stamps.
[[nodiscard]] inline const KindInfo& odometer_kind() {
  static const KindInfo kind{.name = "test_odometer",
                             .description = "scans, and lines at a rate of their own",
                             .program = "quoin-test-odometer",
                             .outputs = {{"scan"}, {"lines", Rate::own_rate}},
                             .parameters = describe_parameters<OdometerParameters>()};
  return kind;
}

}  // namespace quoin::tests
