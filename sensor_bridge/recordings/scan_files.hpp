// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include "sensor_bridge/recordings/parameters.hpp"
#include "sensor_bridge/recordings/recorded_scan.hpp"
#include "sensor_bridge/recordings/scan_geometry.hpp"
#include "sensor_bridge/recordings/scan_reader.hpp"

namespace quoin::sensor_bridge {

/// `path` itself, or the files with scans, by the ends of their names, in the folder
/// `path` in the order of their names. Throws ScanFileError when there is none.
[[nodiscard]] std::vector<std::filesystem::path> list_scan_files(const std::filesystem::path& path);

/// How the file is written, by its first bytes and the end of its name. Throws ScanFileError when
/// that is unknown, or known but not read here: then it says what the file is.
[[nodiscard]] ScanFormat format_of(const std::filesystem::path& file);

/// The scans of a file, or of all files in a folder, one after the other.
class ScanFiles {
 public:
  /// Opens the first file. `field_of_view` [rad] is that of CARMEN scans. Throws ScanFileError.
  /// Scans are as they were recorded.
  ScanFiles(const std::filesystem::path& path, ScanFormat format, double field_of_view);
  /// Scans are as the parameters declare them: geometry and limits of ranges.
  ScanFiles(const std::filesystem::path& path, const ReplayParameters& parameters);

  /// The next scan into `scan`, whose memory is used again; false after the last. Throws
  /// ScanFileError where the input is bad, once all scans before have been given; nothing follows
  /// then.
  bool next(RecordedScan& scan);

  /// How much of the files is read, 0 to 1; nothing where that is not known.
  [[nodiscard]] std::optional<double> progress() const;

  /// Starts again with the first file. Throws ScanFileError.
  void rewind();

 private:
  void open(std::size_t index);

  void pass_over_or_fail();
  [[nodiscard]] bool before_start(const RecordedScan& scan);
  void declare(RecordedScan& scan) const;

  bool folder_ = false;
  std::vector<std::filesystem::path> files_;
  ReplayParameters parameters_;
  ScanGeometry geometry_;
  bool declared_;
  std::optional<double> first_stamp_;  // [s] of the file that is open
  std::vector<std::string> notes_;     // for the next scan
  std::unique_ptr<ScanReader> reader_;
  std::size_t index_ = 0;  // of the file that is open
  std::size_t scans_in_file_ = 0;
};

/// The files that `parameters` name, a relative path starting at `base_directory`. Throws
/// ScanFileError, or ParameterError when the parameters contradict each other.
[[nodiscard]] ScanFiles open_scan_files(const ReplayParameters& parameters,
                                        const std::filesystem::path& base_directory);

}  // namespace quoin::sensor_bridge
