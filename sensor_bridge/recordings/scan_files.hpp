// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <vector>

#include "sensor_bridge/recordings/parameters.hpp"
#include "sensor_bridge/recordings/recorded_scan.hpp"
#include "sensor_bridge/recordings/scan_reader.hpp"

namespace quoin::sensor_bridge {

/// `path` itself, or the .csv, .log and .dat files, plain or compressed, in the folder
/// `path` in the order of their names. Throws ScanFileError when there is none.
[[nodiscard]] std::vector<std::filesystem::path> list_scan_files(const std::filesystem::path& path);

/// How the file is written, by the end of its name. Throws ScanFileError when that is unknown.
[[nodiscard]] ScanFormat format_of(const std::filesystem::path& file);

/// The scans of a file, or of all files in a folder, one after the other.
class ScanFiles {
 public:
  /// Opens the first file. `field_of_view` [rad] is that of CARMEN scans. Throws ScanFileError.
  ScanFiles(const std::filesystem::path& path, ScanFormat format, double field_of_view);

  /// The next scan into `scan`, whose memory is used again; false after the last. Throws
  /// ScanFileError where the input is bad, once all scans before have been given; nothing follows
  /// then.
  bool next(RecordedScan& scan);

  /// Starts again with the first file. Throws ScanFileError.
  void rewind();

 private:
  void open(std::size_t index);

  std::vector<std::filesystem::path> files_;
  ScanFormat requested_format_;
  double field_of_view_;
  std::unique_ptr<ScanReader> reader_;
  std::size_t index_ = 0;  // of the file that is open
  std::size_t scans_in_file_ = 0;
};

/// The files that `parameters` name, a relative path starting at `base_directory`. Throws
/// ScanFileError, or ParameterError when the parameters contradict each other.
[[nodiscard]] ScanFiles open_scan_files(const ReplayParameters& parameters,
                                        const std::filesystem::path& base_directory);

}  // namespace quoin::sensor_bridge
