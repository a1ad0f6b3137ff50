// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "sensor_bridge/recordings/line_reader.hpp"
#include "sensor_bridge/recordings/recorded_scan.hpp"

namespace quoin::sensor_bridge {

/// The scans of one file, whatever its format. A new format is one of these, a name in ScanFormat
/// and a case in `open_scans` (scan_files.cpp).
class ScanReader {
 public:
  ScanReader() = default;
  ScanReader(const ScanReader&) = delete;
  ScanReader& operator=(const ScanReader&) = delete;
  virtual ~ScanReader() = default;

  /// The next scan into `scan`, whose memory is used again; false after the last. Throws
  /// ScanFileError where the file is bad.
  virtual bool next(RecordedScan& scan) = 0;

  /// How much of the file is read, 0 to 1; nothing where that is not known.
  [[nodiscard]] virtual std::optional<double> progress() const { return std::nullopt; }

  /// Throws ScanFileError for the place that was read last.
  [[noreturn]] virtual void fail(const std::string& what) const = 0;
};

/// Of a text file, by a function that reads the lines of one scan.
template <class Read>
class LineScanReader final : public ScanReader {
 public:
  LineScanReader(const std::filesystem::path& file, Read read)
      : lines_(file), read_(std::move(read)) {}

  bool next(RecordedScan& scan) override { return read_(lines_, scan); }
  [[nodiscard]] std::optional<double> progress() const override { return lines_.progress(); }
  [[noreturn]] void fail(const std::string& what) const override { lines_.fail(0, what); }

 private:
  LineReader lines_;
  Read read_;
};

}  // namespace quoin::sensor_bridge
