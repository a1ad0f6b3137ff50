// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "sensor_bridge/recordings/line_reader.hpp"
#include "sensor_bridge/recordings/recorded_scan.hpp"

namespace quoin::sensor_bridge {

/// Reads the one revolution that a CSV file holds: a line "bearing,range" in rad and m per ray, in
/// the order of acquisition, after an optional line of column names; empty lines and lines that
/// start with # are skipped. False when there is no ray (any more). Throws ScanFileError.
bool read_csv_scan(LineReader& lines, RecordedScan& scan);

}  // namespace quoin::sensor_bridge
