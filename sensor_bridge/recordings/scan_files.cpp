// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "sensor_bridge/recordings/scan_files.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

#include "sensor_bridge/message_files/message_file.hpp"
#include "sensor_bridge/range_limits.hpp"
#include "sensor_bridge/recordings/breezyslam.hpp"
#include "sensor_bridge/recordings/carmen.hpp"
#include "sensor_bridge/recordings/csv.hpp"
#include "sensor_bridge/recordings/csv_columns.hpp"
#include "sensor_bridge/recordings/json_triples.hpp"
#include "sensor_bridge/recordings/message_scans.hpp"
#include "sensor_bridge/recordings/scan_json.hpp"

namespace quoin::sensor_bridge {
namespace {

bool is_message_file(std::string_view name) {
  return name.ends_with(".mcap") || name.ends_with(".bag") || name.ends_with(".db3");
}

ScanFormat format_by_name(std::string_view name) {
  if (is_message_file(name)) return ScanFormat::messages;
  if (name.ends_with(".gz")) name.remove_suffix(3);
  if (name.ends_with(".csv")) return ScanFormat::csv;
  if (name.ends_with(".log") || name.ends_with(".clf")) return ScanFormat::carmen;
  if (name.ends_with(".dat")) return ScanFormat::breezyslam;
  if (name.ends_with(".json")) return ScanFormat::json;
  return ScanFormat::automatic;
}

/// What people have scans in that cannot be read here, by the end of its name.
struct ForeignFormat {
  std::string_view ending;
  std::string_view what;
};
constexpr std::array foreign_formats{
    ForeignFormat{".rawlog", "a log of MRPT (rawlog-edit exports its scans as text)"},
    ForeignFormat{".pcd", "a point cloud of PCL, without rays; export x,y as CSV"},
    ForeignFormat{".ply", "a point cloud (PLY), without rays; export x,y as CSV"},
    ForeignFormat{".las", "a point cloud (LAS), without rays; export x,y as CSV"},
    ForeignFormat{".laz", "a point cloud (LAZ), without rays; export x,y as CSV"},
    ForeignFormat{".mat", "data of MATLAB (writematrix gives CSV)"},
    ForeignFormat{".npy", "an array of NumPy (numpy.savetxt gives CSV)"},
    ForeignFormat{".npz", "arrays of NumPy (numpy.savetxt gives CSV)"},
    ForeignFormat{".pickle", "a pickle of Python, which can hold anything (json.dump gives JSON)"},
    ForeignFormat{".pkl", "a pickle of Python, which can hold anything (json.dump gives JSON)"},
    ForeignFormat{".pcap", "a capture of network packets"}};
constexpr const char* known_formats =
    "CARMEN logs, CSV, JSON of [quality, angle, distance], .dat of BreezySLAM, MCAP, ROS 1 and ROS "
    "2 "
    "bags are read";

/// By the first line that says something; automatic when none does.
ScanFormat format_by_content(const std::filesystem::path& file) {
  constexpr int lines_to_look_at = 50;
  LineReader lines(file);
  std::string_view line;
  for (int i = 0; i < lines_to_look_at && lines.next(line); ++i) {
    const std::size_t begin = line.find_first_not_of(" \t");
    if (begin == std::string_view::npos || line[begin] == '#') continue;
    line.remove_prefix(begin);
    if (line.starts_with('[')) return ScanFormat::triples;
    if (line.starts_with('{')) return ScanFormat::json;
    const std::string_view word = line.substr(0, line.find_first_of(" \t"));
    if (word.ends_with("LASER") || word.ends_with("LASER1") || word == "PARAM" || word == "ODOM") {
      return ScanFormat::carmen;
    }
    const bool table = line.find_first_not_of("0123456789+-.eE,;\t \r") == std::string_view::npos;
    const std::size_t columns = split_columns(line, separator_of(line)).size();
    if (table && columns >= 2 && columns <= 8) return ScanFormat::csv;
    if (!table && columns >= 2 && columns <= 12) {
      try {
        (void)layout_of_names(line);
        return ScanFormat::csv;
      } catch (const std::invalid_argument&) {
        continue;
      }
    }
  }
  return ScanFormat::automatic;
}

std::unique_ptr<ScanReader> open_scans(const std::filesystem::path& file,
                                       const ReplayParameters& parameters,
                                       const ScanGeometry& geometry) {
  const auto by_lines = [&](auto read) -> std::unique_ptr<ScanReader> {
    return std::make_unique<LineScanReader<decltype(read)>>(file, std::move(read));
  };
  const ScanFormat format =
      parameters.format == ScanFormat::automatic ? format_of(file) : parameters.format;
  switch (format) {
    case ScanFormat::csv:
      return open_csv_scans(file, parameters.columns);
    case ScanFormat::json:
      return open_scan_json(file, geometry);
    case ScanFormat::triples:
      return open_json_triples(file);
    case ScanFormat::breezyslam:
      return by_lines(BreezySlamScans());
    case ScanFormat::messages:
      return open_message_scans(file, parameters);
    case ScanFormat::automatic:
    case ScanFormat::carmen:
      break;
  }
  return by_lines(CarmenScans(geometry));
}

ScanGeometry geometry_of(const ReplayParameters& parameters) {
  return {parameters.field_of_view,  parameters.start_angle, parameters.angle_step,
          parameters.clockwise,      parameters.inverted,    parameters.angle_offset,
          parameters.leave_out_from, parameters.leave_out_to};
}

ReplayParameters as_recorded(ScanFormat format, double field_of_view) {
  ReplayParameters parameters;
  parameters.format = format;
  parameters.field_of_view = field_of_view;
  return parameters;
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
    throw ScanFileError("folder '" + path.string() +
                        "' holds no scan file (.csv, .log, .clf, .dat, .mcap, .bag, .db3)");
  }
  std::sort(files.begin(), files.end());
  return files;
}

ScanFormat format_of(const std::filesystem::path& file) {
  if (message_file_kind(file)) return ScanFormat::messages;
  const std::string name = file.filename().string();
  for (const ForeignFormat& foreign : foreign_formats) {
    if (!name.ends_with(foreign.ending)) continue;
    throw ScanFileError("'" + file.string() + "' is " + std::string(foreign.what) + "; " +
                        known_formats);
  }
  if (is_message_file(name)) {
    throw ScanFileError(
        "'" + file.string() +
        "' does not begin as an MCAP file or bag does; it is damaged, or of another "
        "kind");
  }
  const ScanFormat by_content = format_by_content(file);
  const ScanFormat by_name = format_by_name(name);
  if (by_name == ScanFormat::json && by_content == ScanFormat::triples) return by_content;
  if (by_name != ScanFormat::automatic) return by_name;
  if (by_content == ScanFormat::automatic) {
    throw ScanFileError("cannot find out how scan file '" + file.string() + "' is written; " +
                        known_formats + "; set 'format' to say which of them it is");
  }
  return by_content;
}

ScanFiles::ScanFiles(const std::filesystem::path& path, ScanFormat format, double field_of_view)
    : folder_(std::filesystem::is_directory(path)),
      files_(list_scan_files(path)),
      parameters_(as_recorded(format, field_of_view)),
      geometry_(geometry_of(parameters_)),
      declared_(false) {
  rewind();
}

ScanFiles::ScanFiles(const std::filesystem::path& path, const ReplayParameters& parameters)
    : folder_(std::filesystem::is_directory(path)),
      files_(list_scan_files(path)),
      parameters_(parameters),
      geometry_(geometry_of(parameters)),
      declared_(true) {
  rewind();
}

bool ScanFiles::next(RecordedScan& scan) {
  while (true) {
    if (!reader_) return false;
    bool found = false;
    try {
      found = reader_->next(scan);
    } catch (const ScanFileError&) {
      reader_.reset();
      throw;
    }
    if (!found && scans_in_file_ == 0) {
      pass_over_or_fail();
      continue;
    }
    if (found) {
      scan.first_of_file = scans_in_file_ == 0;
      ++scans_in_file_;
      if (before_start(scan)) continue;
      scan.notes.insert(scan.notes.begin(), notes_.begin(), notes_.end());
      notes_.clear();
      if (declared_) declare(scan);
      return true;
    }
    reader_.reset();
    if (index_ + 1 == files_.size()) return false;
    open(index_ + 1);
  }
}

/// A file of a folder that holds nothing of a scan may be something else.
void ScanFiles::pass_over_or_fail() {
  try {
    reader_->fail(
        "the file ends here and holds no scan; is it a scan file, and is 'format' right?");
  } catch (const ScanFileError& error) {
    reader_.reset();
    if (!folder_ || files_.size() < 2) throw;
    notes_.push_back(std::string("passed over: ") + error.what());
  }
  files_.erase(files_.begin() + static_cast<std::ptrdiff_t>(index_));
  if (index_ < files_.size()) open(index_);
}

/// Messages know their time without being read.
bool ScanFiles::before_start(const RecordedScan& scan) {
  if (!(parameters_.start > 0.0) || !scan.stamp || scan.epoch_stamp) return false;
  if (scan.first_of_file) first_stamp_ = scan.stamp;
  return *scan.stamp - first_stamp_.value_or(*scan.stamp) < parameters_.start;
}

void ScanFiles::declare(RecordedScan& scan) const {
  apply_geometry(geometry_, scan);
  if (scan.sensor) return;
  const bool of_file = scan.range_max && parameters_.range_max == ReplayParameters::usual_range_max;
  // A range of a file's own limit is a return.
  const double longest = of_file ? std::nextafter(static_cast<float>(*scan.range_max), HUGE_VALF)
                                 : parameters_.range_max;
  apply_range_limits(parameters_.range_min, longest, scan.ranges);
}

std::optional<double> ScanFiles::progress() const {
  const auto in_file = reader_ ? reader_->progress() : std::nullopt;
  if (!in_file) return std::nullopt;
  return (static_cast<double>(index_) + *in_file) / static_cast<double>(files_.size());
}

void ScanFiles::rewind() { open(0); }

void ScanFiles::open(std::size_t index) {
  reader_.reset();
  index_ = index;
  scans_in_file_ = 0;
  reader_ = open_scans(files_[index], parameters_, geometry_);
}

ScanFiles open_scan_files(const ReplayParameters& parameters,
                          const std::filesystem::path& base_directory) {
  check_range_limits(parameters);
  return {base_directory / parameters.path, parameters};
}

}  // namespace quoin::sensor_bridge
