// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/simulation/scanner.hpp"
#include "sensor_bridge/simulated/parameters.hpp"

namespace quoin::sensor_bridge {

/// The scanner that `parameters` describe. Throws ParameterError when they contradict each other.
[[nodiscard]] ScannerSettings scanner_settings(const SimulatedParameters& parameters);

}  // namespace quoin::sensor_bridge
