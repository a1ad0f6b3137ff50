// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>

#include "sensor_bridge/recordings/scan_reader.hpp"

namespace quoin::sensor_bridge {

/// Lists of [quality, angle, distance] in degrees and millimetres, as Python drivers of RPLIDARs
/// give them and json.dump writes them: one list of rays, one a line, or a list of revolutions.
/// Pairs of [angle, distance] are read, too. Throws ScanFileError.
[[nodiscard]] std::unique_ptr<ScanReader> open_json_triples(const std::filesystem::path& file);

}  // namespace quoin::sensor_bridge
