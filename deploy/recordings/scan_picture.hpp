// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "deploy/evaluation/drawing/drawing.hpp"

namespace quoin::deploy {

/// Which scan of a recording, and what was made of it.
struct RecordedScanChoice {
  std::string topic;              ///< of scans; "": the only one
  std::string service;            ///< whose result is drawn; "": the only one of corners, or lines
  std::uint64_t scan = 0;         ///< from 0
  std::optional<double> at = {};  ///< [s] since the first scan: the first that is not before
};

/// The scan of a file of any format that replay reads; of a recording of ours with the lines,
/// corners and circles that were made of it. Throws ScanFileError for a file that cannot be read,
/// and std::out_of_range for a scan or service that is not there.
[[nodiscard]] Drawing picture_of_recording(const std::filesystem::path& file,
                                           const RecordedScanChoice& choice);

}  // namespace quoin::deploy
