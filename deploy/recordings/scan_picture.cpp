// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "deploy/recordings/scan_picture.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <idl/Circles.h>
#include <idl/Corners.h>
#include <idl/Lines.h>
#include <map>
#include <stdexcept>
#include <vector>

#include "deploy/observation/message_drawing.hpp"
#include "sensor_bridge/message_files/message_file.hpp"
#include "sensor_bridge/recordings/scan_files.hpp"
#include "services/topics/cdr_codec.hpp"
#include "services/topics/header.hpp"

namespace quoin::deploy {

namespace {

using sensor_bridge::FileMessage;
using sensor_bridge::RecordedScan;

struct FoundScan {
  RecordedScan scan;
  std::uint64_t number = 0;
  double time = 0.0;  // [s] since the first
};

FoundScan find_scan(const std::filesystem::path& file, const RecordedScanChoice& choice) {
  sensor_bridge::ReplayParameters parameters;
  parameters.topic = choice.topic;
  sensor_bridge::ScanFiles files(file, parameters);
  FoundScan found;
  std::optional<double> first;
  for (std::uint64_t number = 0; files.next(found.scan); ++number) {
    if (!first) first = found.scan.stamp;
    found.number = number;
    found.time = found.scan.stamp ? *found.scan.stamp - *first : 0.0;
    if (choice.at ? found.time >= *choice.at : number == choice.scan) return found;
  }
  std::array<char, 64> last{};
  std::snprintf(last.data(), last.size(), "its last is %llu, %.3f s after the first",
                static_cast<unsigned long long>(found.number), found.time);
  throw std::out_of_range(file.string() + ": there is no scan " +
                          (choice.at ? "so late" : std::to_string(choice.scan)) + "; " +
                          last.data());
}

/// What was made of one scan, by topic.
struct Results {
  std::map<std::string, msg::Lines> lines;
  std::map<std::string, msg::Corners> corners;
  std::map<std::string, msg::Circles> circles;
};

template <class T>
void keep(const FileMessage& message, std::int64_t stamp, std::map<std::string, T>& results) {
  if (message.topic->type != topics::cdr_codec<T>().type_name || message.topic->encoding != "cdr") {
    return;
  }
  T result;
  const auto* bytes = reinterpret_cast<const std::byte*>(message.data.data());
  if (!topics::decode(topics::cdr_codec<T>(), bytes, message.data.size(), &result)) return;
  if (result.header().stamp() == stamp) results[message.topic->name] = std::move(result);
}

Results results_of(const std::filesystem::path& file, std::int64_t stamp) {
  // Results come within that time of their scan.
  constexpr std::int64_t latest = 10'000'000'000;  // [ns]
  const auto messages = sensor_bridge::open_message_file(file);
  Results results;
  FileMessage message;
  std::optional<std::int64_t> found_at;
  while (messages->next(message)) {
    if (found_at && message.log_time > *found_at + latest) break;
    const std::size_t before = results.lines.size() + results.corners.size();
    keep(message, stamp, results.lines);
    keep(message, stamp, results.corners);
    keep(message, stamp, results.circles);
    if (!found_at && results.lines.size() + results.corners.size() > before) {
      found_at = message.log_time;
    }
  }
  return results;
}

/// The service that published a message.
template <class T>
std::string service_of(const T& message) {
  const auto& trace = message.header().trace();
  return trace.empty() ? "" : trace.back().service();
}

/// Null when there is none; throws when it is unclear which.
template <class T>
const T* choose(const std::map<std::string, T>& results, const std::string& service,
                const std::string& file) {
  const T* found = nullptr;
  std::vector<std::string> services;
  for (const auto& [topic, message] : results) {
    services.push_back(service_of(message));
    if (service.empty() || services.back() == service) found = &message;
  }
  if (!service.empty() || results.size() < 2) return found;
  std::string names;
  for (const std::string& each : services) names += (names.empty() ? "" : ", ") + each;
  throw std::out_of_range(file + ": several services have results (" + names +
                          "); name one with --service");
}

bool came_through(const msg::Header& header, const std::string& service) {
  return std::ranges::any_of(
      header.trace(), [&](const msg::StageTrace& stage) { return stage.service() == service; });
}

void add_results(const Results& results, const RecordedScanChoice& choice, const std::string& file,
                 Drawing& drawing) {
  if (results.lines.empty() && results.corners.empty() && choice.service.empty()) return;
  const msg::Corners* corners = choose(results.corners, choice.service, file);
  const msg::Lines* lines = nullptr;
  if (corners != nullptr) {
    for (const auto& [topic, message] : results.lines) {
      if (came_through(corners->header(), service_of(message))) lines = &message;
    }
  } else {
    lines = choose(results.lines, choice.service, file);
  }
  if (corners == nullptr && lines == nullptr) {
    throw std::out_of_range(file + ": of '" + choice.service +
                            "' there are neither corners nor lines of that scan");
  }
  const msg::Header& header = corners != nullptr ? corners->header() : lines->header();
  if (lines != nullptr) add_lines(*lines, drawing);
  if (corners != nullptr) add_corners(*corners, drawing);
  for (const auto& [topic, message] : results.circles) {
    const auto& trace = message.header().trace();
    // Of the same segments.
    if (trace.size() > 1 && came_through(header, trace[trace.size() - 2].service())) {
      add_circles(message, drawing);
    }
  }
  drawing.caption += "; " + stages_text(header);
}

}  // namespace

Drawing picture_of_recording(const std::filesystem::path& file, const RecordedScanChoice& choice) {
  const FoundScan found = find_scan(file, choice);
  Drawing drawing;
  add_points(found.scan.bearings, found.scan.ranges, drawing);
  drawing.title = file.filename().string() + ", scan " + std::to_string(found.number);
  std::array<char, 48> time{};
  std::snprintf(time.data(), time.size(), "%.3f s after the first", found.time);
  drawing.caption = time.data();
  if (!found.scan.frame.empty()) drawing.caption += ", frame " + found.scan.frame;
  const bool ours = found.scan.sensor && found.scan.epoch_stamp;
  if (ours) add_results(results_of(file, *found.scan.epoch_stamp), choice, file.string(), drawing);
  if (!ours && !choice.service.empty()) {
    throw std::out_of_range(file.string() +
                            ": it is no recording of ours, and has scans only; "
                            "leave --service out");
  }
  return drawing;
}

}  // namespace quoin::deploy
