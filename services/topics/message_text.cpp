// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/topics/message_text.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <sstream>
#include <utility>

#include <nlohmann/json.hpp>

#include "core/text/printable.hpp"

namespace quoin::topics {

namespace {

using Json = nlohmann::ordered_json;

constexpr double degrees_per_radian = 57.29577951308232;

std::string fixed(double value, int digits) {
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), "%.*f", digits, value);
  return text.data();
}

double real(const Json& message, const char* field) {
  const Json& value = message.at(field);
  return value.is_null() ? std::numeric_limits<double>::quiet_NaN() : value.get<double>();
}

std::int64_t nanoseconds(const Json& message, const char* field) {
  return message.at(field).get<std::int64_t>();
}

std::uint64_t count(const Json& message, const char* field) {
  return message.at(field).get<std::uint64_t>();
}

std::string text_of(const Json& message, const char* field) {
  return message.at(field).get<std::string>();
}

std::string header_text(const Json& header) {
  std::ostringstream text;
  const Json& origins = header.at("origins");
  if (origins.empty()) {
    text << " #0";
  } else {
    text << text_of(origins[0], "source") << " #" << count(origins[0], "sequence_number");
  }
  text << " stamp " << fixed(static_cast<double>(nanoseconds(header, "stamp")) * 1e-9, 6) << ' '
       << text_of(header, "frame");
  const Json& trace = header.at("trace");
  if (trace.size() > 1) {
    const std::int64_t latency =
        nanoseconds(trace.back(), "published") - nanoseconds(trace.front(), "published");
    text << " +" << fixed(static_cast<double>(latency) * 1e-6, 2) << " ms";
  }
  text << ':';
  return text.str();
}

std::string scan_text(const Json& scan) {
  const Json& ranges = scan.at("ranges");
  const double shortest = real(scan, "range_min");
  const double longest = real(scan, "range_max");
  // Not a number is what is infinite or not a number in the scan.
  const auto valid = std::count_if(ranges.begin(), ranges.end(), [&](const Json& range) {
    return range.is_number() && range > 0.0 && range >= shortest && range <= longest;
  });
  std::ostringstream text;
  text << ' ' << ranges.size() << " rays, " << valid << " valid, in "
       << fixed(real(scan, "duration"), 3) << " s";
  return text.str();
}

std::string segments_text(const Json& message) {
  std::ostringstream text;
  text << ' ' << message.at("segments").size() << " segments of " << message.at("ranges").size()
       << " points";
  if (const auto no_return = message.value("no_return", std::uint64_t{0}); no_return > 0) {
    text << ", " << no_return << " of them no return";
  }
  text << ':';
  for (const Json& range : message.at("segments")) {
    text << ' ' << count(range, "begin") << ".." << count(range, "end");
  }
  if (const auto arcs = message.find("arcs"); arcs != message.end() && !arcs->empty()) {
    text << "; " << arcs->size() << " arcs:";
    for (const Json& range : *arcs) {
      text << ' ' << count(range, "begin") << ".." << count(range, "end");
    }
  }
  return text.str();
}

std::string lines_text(const Json& message) {
  std::ostringstream text;
  text << ' ' << message.at("lines").size() << " lines:";
  for (const Json& line : message.at("lines")) {
    text << " alpha " << fixed(real(line, "alpha") * degrees_per_radian, 2) << " deg r "
         << fixed(real(line, "r"), 3) << " m (" << count(line, "points") << " points);";
  }
  for (const Json& failure : message.at("failures")) {
    text << " segment " << count(failure, "segment") << ' ' << text_of(failure, "reason") << ';';
  }
  return text.str();
}

std::string corners_text(const Json& message) {
  std::ostringstream text;
  text << ' ' << message.at("corners").size() << " corners:";
  for (const Json& corner : message.at("corners")) {
    const double sigma =
        std::sqrt(0.5 * (real(corner, "covariance_xx") + real(corner, "covariance_yy")));
    text << " (" << fixed(real(corner, "x"), 3) << ", " << fixed(real(corner, "y"), 3)
         << ") m sigma " << fixed(sigma * 1e3, 2) << " mm;";
  }
  return text.str();
}

std::string circles_text(const Json& message) {
  std::ostringstream text;
  text << ' ' << message.at("circles").size() << " circles:";
  for (const Json& circle : message.at("circles")) {
    const double sigma =
        std::sqrt(0.5 * (real(circle, "covariance_xx") + real(circle, "covariance_yy")));
    text << " (" << fixed(real(circle, "x"), 3) << ", " << fixed(real(circle, "y"), 3)
         << ") m radius " << fixed(real(circle, "radius"), 3) << " m sigma "
         << fixed(sigma * 1e3, 2) << " mm (" << count(circle, "points") << " points);";
  }
  for (const Json& failure : message.at("failures")) {
    text << " arc " << count(failure, "arc") << ' ' << text_of(failure, "reason") << ';';
  }
  return text.str();
}

/// "(1.000, -2.000) m 90.00 deg", and what it is known to.
std::string pose_estimate_text(const Json& estimate) {
  const double sigma =
      std::sqrt(0.5 * (real(estimate, "covariance_xx") + real(estimate, "covariance_yy")));
  return " (" + fixed(real(estimate, "x"), 3) + ", " + fixed(real(estimate, "y"), 3) + ") m " +
         fixed(real(estimate, "theta") * degrees_per_radian, 2) + " deg sigma " +
         fixed(sigma * 1e3, 1) + " mm " +
         fixed(std::sqrt(real(estimate, "covariance_theta")) * degrees_per_radian, 3) + " deg";
}

std::string odometry_text(const Json& message) {
  std::string text = pose_estimate_text(message.at("pose"));
  if (!message.at("velocity_known").get<bool>()) return text;
  return text + ", " +
         fixed(std::hypot(real(message, "velocity_x"), real(message, "velocity_y")), 3) + " m/s " +
         fixed(real(message, "velocity_theta") * degrees_per_radian, 2) + " deg/s";
}

std::string pose_text(const Json& message) {
  std::string status = text_of(message, "status");
  if (status.starts_with("POSE_")) status.erase(0, 5);
  std::ranges::transform(status, status.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  std::string text = pose_estimate_text(message.at("pose")) + ", " + status;
  if (const Json& weak = message.at("weak_direction"); weak.is_number()) {
    text += " along " + fixed(weak.get<double>() * degrees_per_radian, 1) + " deg";
  }
  return text + ", " + std::to_string(count(message, "matched")) + " of " +
         std::to_string(count(message, "lines")) + " lines in the map";
}

std::string line_map_text(const Json& message) {
  double length = 0.0;
  for (const Json& line : message.at("lines")) {
    const Json& start = line.at("start");
    const Json& end = line.at("end");
    length += std::hypot(real(end, "x") - real(start, "x"), real(end, "y") - real(start, "y"));
  }
  std::ostringstream text;
  text << " version " << count(message, "version") << ", part " << count(message, "part") + 1
       << " of " << count(message, "parts") << ": " << message.at("lines").size() << " walls of "
       << fixed(length, 1) << " m";
  return text.str();
}

// Appends " name value," for each single value and " name[length]," for each sequence.
void append_fields(const Json& object, const std::string& prefix, std::string& text) {
  for (const auto& [name, value] : object.items()) {
    if (value.is_object()) {
      append_fields(value, prefix + name + '.', text);
    } else if (value.is_array()) {
      text += ' ' + prefix + name + '[' + std::to_string(value.size()) + "],";
    } else {
      text += ' ' + prefix + name + ' ' +
              (value.is_string() ? value.get<std::string>() : value.dump()) + ',';
    }
  }
}

std::string fields_text(const Json& message) {
  std::string text;
  append_fields(message, "", text);
  if (!text.empty()) text.pop_back();
  return text;
}

std::string fields_without_header(Json message) {
  message.erase("header");
  return fields_text(message);
}

// Types with a text that says more than their fields would.
constexpr std::pair<std::string_view, std::string (*)(const Json&)> texts[] = {
    {"quoin::msg::Scan", scan_text},       {"quoin::msg::Segments", segments_text},
    {"quoin::msg::Lines", lines_text},     {"quoin::msg::Corners", corners_text},
    {"quoin::msg::Circles", circles_text}, {"quoin::msg::Odometry", odometry_text},
    {"quoin::msg::Pose", pose_text},       {"quoin::msg::LineMap", line_map_text}};

// Throws Json::exception for a message without our header, or of another version of its type.
std::string own_text(std::string_view dds_type, const Json& message) {
  const auto* special =
      std::ranges::find(texts, dds_type, [](const auto& row) { return row.first; });
  return header_text(message.at("header")) +
         (special == std::end(texts) ? fields_without_header(message) : special->second(message));
}

}  // namespace

std::string to_text(std::string_view dds_type, const Json& message) {
  std::string text;
  try {
    text = own_text(dds_type, message);
  } catch (const Json::exception&) {
    text = fields_text(message);
  }
  if (text.starts_with(' ')) text.erase(0, 1);
  return printable(text);  // a name may come from anybody and goes to a terminal
}

}  // namespace quoin::topics
