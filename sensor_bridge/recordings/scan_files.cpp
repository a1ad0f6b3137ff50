// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "sensor_bridge/recordings/scan_files.hpp"

#include <algorithm>
#include <cerrno>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

#include "sensor_bridge/range_limits.hpp"
#include "sensor_bridge/recordings/breezyslam.hpp"
#include "sensor_bridge/recordings/carmen.hpp"
#include "sensor_bridge/recordings/csv.hpp"
#include "sensor_bridge/recordings/scan_json.hpp"

namespace quoin::sensor_bridge {
namespace {

ScanFormat format_by_name(std::string_view name) {
  if (name.ends_with(".csv")) return ScanFormat::csv;
  if (name.ends_with(".gz")) name.remove_suffix(3);
  if (name.ends_with(".log")) return ScanFormat::carmen;
  if (name.ends_with(".dat")) return ScanFormat::breezyslam;
  if (name.ends_with(".json")) return ScanFormat::json;
  return ScanFormat::automatic;
}

std::unique_ptr<ScanReader> open_scans(const std::filesystem::path& file, ScanFormat format,
                                       double field_of_view) {
  const auto by_lines = [&](auto read) -> std::unique_ptr<ScanReader> {
    return std::make_unique<LineScanReader<decltype(read)>>(file, std::move(read));
  };
  switch (format) {
    case ScanFormat::csv:
      return by_lines(read_csv_scan);
    case ScanFormat::json:
      return open_scan_json(file, field_of_view);
    case ScanFormat::breezyslam:
      return by_lines(BreezySlamScans());
    case ScanFormat::automatic:
      return open_scans(file, format_of(file), field_of_view);
    case ScanFormat::carmen:
      break;
  }
  return by_lines([field_of_view](LineReader& lines, RecordedScan& scan) {
    return read_carmen_scan(lines, field_of_view, scan);
  });
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
    const ScanFormat format = format_by_name(entry->path().filename().string());
    // Other things than scans are kept as JSON as well.
    const bool has_scans = format != ScanFormat::automatic && format != ScanFormat::json;
    if (has_scans && !entry->is_directory(error)) files.push_back(entry->path());
  }
  if (files.empty()) {
    throw ScanFileError("folder '" + path.string() + "' holds no .csv, .log or .dat file");
  }
  std::sort(files.begin(), files.end());
  return files;
}

ScanFormat format_of(const std::filesystem::path& file) {
  const ScanFormat format = format_by_name(file.filename().string());
  if (format == ScanFormat::automatic) {
    throw ScanFileError("cannot find out how scan file '" + file.string() +
                        "' is written; set 'format' to carmen, csv, json or breezyslam");
  }
  return format;
}

ScanFiles::ScanFiles(const std::filesystem::path& path, ScanFormat format, double field_of_view)
    : files_(list_scan_files(path)), requested_format_(format), field_of_view_(field_of_view) {
  rewind();
}

bool ScanFiles::next(RecordedScan& scan) {
  while (true) {
    if (!reader_) return false;
    bool found = false;
    try {
      found = reader_->next(scan);
      if (!found && scans_in_file_ == 0) {
        reader_->fail(
            "the file ends here and holds no scan; is it a scan file, and is 'format' right?");
      }
    } catch (const ScanFileError&) {
      reader_.reset();
      throw;
    }
    if (found) {
      scan.first_of_file = scans_in_file_ == 0;
      ++scans_in_file_;
      return true;
    }
    reader_.reset();
    if (index_ + 1 == files_.size()) return false;
    open(index_ + 1);
  }
}

void ScanFiles::rewind() { open(0); }

void ScanFiles::open(std::size_t index) {
  reader_.reset();
  index_ = index;
  scans_in_file_ = 0;
  reader_ = open_scans(files_[index], requested_format_, field_of_view_);
}

ScanFiles open_scan_files(const ReplayParameters& parameters,
                          const std::filesystem::path& base_directory) {
  check_range_limits(parameters);
  return {base_directory / parameters.path, parameters.format, parameters.field_of_view};
}

}  // namespace quoin::sensor_bridge
