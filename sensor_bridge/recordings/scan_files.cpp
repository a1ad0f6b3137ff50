// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "sensor_bridge/recordings/scan_files.hpp"

#include <algorithm>
#include <cerrno>
#include <string>
#include <system_error>

#include "sensor_bridge/range_limits.hpp"
#include "sensor_bridge/recordings/carmen.hpp"
#include "sensor_bridge/recordings/csv.hpp"

namespace quoin::sensor_bridge {
namespace {

ScanFormat format_by_name(const std::string& name) {
  if (name.ends_with(".csv")) return ScanFormat::csv;
  if (name.ends_with(".log") || name.ends_with(".log.gz")) return ScanFormat::carmen;
  return ScanFormat::automatic;
}

}  // namespace

std::vector<std::filesystem::path> list_scan_files(const std::filesystem::path& path) {
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status)) {
    throw ScanFileError("cannot read scan file '" + path.string() +
                        "': " + std::generic_category().message(error ? error.value() : ENOENT));
  }
  if (!std::filesystem::is_directory(status)) return {path};

  std::vector<std::filesystem::path> files;
  std::filesystem::directory_iterator entry(path, error);
  if (error) throw ScanFileError("cannot read folder '" + path.string() + "': " + error.message());
  for (; entry != std::filesystem::directory_iterator(); entry.increment(error)) {
    const bool has_scans = format_by_name(entry->path().filename()) != ScanFormat::automatic;
    if (has_scans && !entry->is_directory(error)) files.push_back(entry->path());
  }
  if (files.empty()) {
    throw ScanFileError("folder '" + path.string() + "' holds no .csv, .log or .log.gz file");
  }
  std::sort(files.begin(), files.end());
  return files;
}

ScanFormat format_of(const std::filesystem::path& file) {
  const ScanFormat format = format_by_name(file.filename());
  if (format == ScanFormat::automatic) {
    throw ScanFileError("cannot find out how scan file '" + file.string() +
                        "' is written; set 'format' to carmen or csv");
  }
  return format;
}

ScanFiles::ScanFiles(const std::filesystem::path& path, ScanFormat format, double field_of_view)
    : files_(list_scan_files(path)), requested_format_(format), field_of_view_(field_of_view) {
  rewind();
}

bool ScanFiles::next(RecordedScan& scan) {
  while (true) {
    if (!lines_) return false;
    bool found = false;
    try {
      found = read(scan);
      if (!found && scans_in_file_ == 0) {
        lines_->fail(
            0, "the file ends here and holds no scan; is it a scan file, and is 'format' right?");
      }
    } catch (const ScanFileError&) {
      lines_.reset();
      throw;
    }
    if (found) {
      scan.first_of_file = scans_in_file_ == 0;
      ++scans_in_file_;
      return true;
    }
    lines_.reset();
    if (index_ + 1 == files_.size()) return false;
    open(index_ + 1);
  }
}

void ScanFiles::rewind() { open(0); }

void ScanFiles::open(std::size_t index) {
  lines_.reset();
  index_ = index;
  scans_in_file_ = 0;
  format_ =
      requested_format_ == ScanFormat::automatic ? format_of(files_[index]) : requested_format_;
  lines_.emplace(files_[index]);
}

bool ScanFiles::read(RecordedScan& scan) {
  return format_ == ScanFormat::csv ? read_csv_scan(*lines_, scan)
                                    : read_carmen_scan(*lines_, field_of_view_, scan);
}

ScanFiles open_scan_files(const ReplayParameters& parameters,
                          const std::filesystem::path& base_directory) {
  check_range_limits(parameters);
  return {base_directory / parameters.path, parameters.format, parameters.field_of_view};
}

}  // namespace quoin::sensor_bridge
