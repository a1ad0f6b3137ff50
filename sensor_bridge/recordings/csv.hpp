// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>

#include "sensor_bridge/recordings/scan_reader.hpp"

namespace quoin::sensor_bridge {

/// Rays as a table, a line each, in the order of acquisition: bearing and range, or x and y, with
/// further columns. Separators, columns and units are those of the line of names, where there is
/// one, else guessed by the first rays; what was guessed becomes a note of the first scan. A new
/// revolution begins where the bearing comes round, or the column that numbers revolutions changes.
/// A table of nothing but names is a revolution of no rays. Empty lines and lines that start with #
/// are skipped.
///
/// `columns`: names in place of those of the file, such as "quality;angle_deg;distance_mm"; "" for
/// none. Throws ScanFileError.
[[nodiscard]] std::unique_ptr<ScanReader> open_csv_scans(const std::filesystem::path& file,
                                                         const std::string& columns);

}  // namespace quoin::sensor_bridge
