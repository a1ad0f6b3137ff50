// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/topics/message_text.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <sstream>

#include "services/topics/header.hpp"

namespace quoin::topics {

namespace {

std::string fixed(double value, int digits) {
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), "%.*f", digits, value);
  return text.data();
}

constexpr double degrees_per_radian = 57.29577951308232;

std::string header_text(const msg::Header& header) {
  std::ostringstream text;
  text << source(header) << " #" << sequence_number(header) << " stamp "
       << fixed(static_cast<double>(header.stamp()) * 1e-9, 6) << ' ' << header.frame();
  if (header.trace().size() > 1) {
    const auto latency = header.trace().back().published() - header.trace().front().published();
    text << " +" << fixed(static_cast<double>(latency) * 1e-6, 2) << " ms";
  }
  text << ':';
  return text.str();
}

}  // namespace

std::string to_text(const msg::Scan& message) {
  const auto& ranges = message.ranges();
  const auto valid = std::count_if(ranges.begin(), ranges.end(), [&](float range) {
    return range > 0.0F && range >= message.range_min() && range <= message.range_max();
  });
  std::ostringstream text;
  text << header_text(message.header()) << ' ' << ranges.size() << " rays, " << valid
       << " valid, in " << fixed(message.duration(), 3) << " s";
  return text.str();
}

std::string to_text(const msg::Segments& message) {
  std::ostringstream text;
  text << header_text(message.header()) << ' ' << message.segments().size() << " segments of "
       << message.ranges().size() << " points:";
  for (const msg::IndexRange& range : message.segments()) {
    text << ' ' << range.begin() << ".." << range.end();
  }
  return text.str();
}

std::string to_text(const msg::Lines& message) {
  std::ostringstream text;
  text << header_text(message.header()) << ' ' << message.lines().size() << " lines:";
  for (const msg::Line& line : message.lines()) {
    text << " alpha " << fixed(line.alpha() * degrees_per_radian, 2) << " deg r "
         << fixed(line.r(), 3) << " m (" << line.points() << " points);";
  }
  for (const msg::Failure& failure : message.failures()) {
    text << " segment " << failure.segment() << ' ' << failure.reason() << ';';
  }
  return text.str();
}

std::string to_text(const msg::Corners& message) {
  std::ostringstream text;
  text << header_text(message.header()) << ' ' << message.corners().size() << " corners:";
  for (const msg::Corner& corner : message.corners()) {
    const double sigma = std::sqrt(0.5 * (corner.covariance_xx() + corner.covariance_yy()));
    text << " (" << fixed(corner.x(), 3) << ", " << fixed(corner.y(), 3) << ") m sigma "
         << fixed(sigma * 1e3, 2) << " mm;";
  }
  return text.str();
}

}  // namespace quoin::topics
