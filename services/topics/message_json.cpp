// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/topics/message_json.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <vector>

#include <nlohmann/json.hpp>

namespace quoin::topics {

namespace {

using Json = nlohmann::ordered_json;

/// The double that prints as shortly as the float does.
Json number(float value) {
  if (!std::isfinite(value)) return nullptr;
  std::array<char, 32> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
  double shortest = 0.0;
  std::from_chars(text.data(), end, shortest);
  return shortest;
}

Json numbers(const std::vector<float>& values) {
  Json list = Json::array();
  for (const float value : values) list.push_back(number(value));
  return list;
}

Json point(const msg::Point& value) { return {{"x", value.x()}, {"y", value.y()}}; }

Json header(const msg::Header& value) {
  Json trace = Json::array();
  for (const msg::StageTrace& stage : value.trace()) {
    trace.push_back({{"service", stage.service()},
                     {"input", stage.input()},
                     {"method", stage.method()},
                     {"incarnation", stage.incarnation()},
                     {"index", stage.index()},
                     {"received", stage.received()},
                     {"published", stage.published()}});
  }
  Json origins = Json::array();
  for (const msg::Origin& origin : value.origins()) {
    origins.push_back({{"source", origin.source()},
                       {"incarnation", origin.incarnation()},
                       {"sequence_number", origin.sequence_number()},
                       {"part", origin.part()},
                       {"parts", origin.parts()}});
  }
  return {{"origins", origins},
          {"stamp", value.stamp()},
          {"frame", value.frame()},
          {"trace", trace}};
}

Json sensor_model(const msg::SensorModel& value) {
  return {{"range_stddev", value.range_stddev()},
          {"bearing_stddev", value.bearing_stddev()},
          {"range_bias_stddev", value.range_bias_stddev()}};
}

Json line(const msg::Line& value) {
  return {{"alpha", value.alpha()},
          {"r", value.r()},
          {"covariance_alpha", value.covariance_alpha()},
          {"covariance_alpha_r", value.covariance_alpha_r()},
          {"covariance_r", value.covariance_r()},
          {"start", point(value.start())},
          {"end", point(value.end())},
          {"points", value.points()},
          {"chi_square", value.chi_square()},
          {"segment", value.segment()}};
}

Json corner(const msg::Corner& value) {
  return {{"x", value.x()},
          {"y", value.y()},
          {"covariance_xx", value.covariance_xx()},
          {"covariance_xy", value.covariance_xy()},
          {"covariance_yy", value.covariance_yy()},
          {"ellipse_area", value.ellipse_area()},
          {"ellipse95_major", value.ellipse95_major()},
          {"ellipse95_minor", value.ellipse95_minor()},
          {"ellipse95_direction", value.ellipse95_direction()},
          {"angle", value.angle()},
          {"gap", value.gap()},
          {"extrapolation", value.extrapolation()},
          {"first_line", value.first_line()},
          {"second_line", value.second_line()}};
}

}  // namespace

Json to_json(const msg::Scan& message) {
  return {{"header", header(message.header())},
          {"sensor_model", sensor_model(message.sensor_model())},
          {"range_min", number(message.range_min())},
          {"range_max", number(message.range_max())},
          {"duration", number(message.duration())},
          {"bearings", numbers(message.bearings())},
          {"ranges", numbers(message.ranges())},
          {"qualities", numbers(message.qualities())},
          {"time_offsets", numbers(message.time_offsets())}};
}

Json to_json(const msg::Segments& message) {
  Json segments = Json::array();
  for (const msg::IndexRange& range : message.segments()) {
    segments.push_back({{"begin", range.begin()}, {"end", range.end()}});
  }
  return {{"header", header(message.header())},
          {"sensor_model", sensor_model(message.sensor_model())},
          {"scan_points", message.scan_points()},
          {"bearings", numbers(message.bearings())},
          {"ranges", numbers(message.ranges())},
          {"segments", segments}};
}

Json to_json(const msg::Lines& message) {
  Json lines = Json::array();
  for (const msg::Line& value : message.lines()) lines.push_back(line(value));
  Json failures = Json::array();
  for (const msg::Failure& failure : message.failures()) {
    failures.push_back({{"segment", failure.segment()}, {"reason", failure.reason()}});
  }
  return {{"header", header(message.header())},
          {"sensor_model", sensor_model(message.sensor_model())},
          {"covariance_mode", message.covariance_mode()},
          {"lines", lines},
          {"failures", failures}};
}

Json to_json(const msg::Corners& message) {
  Json corners = Json::array();
  for (const msg::Corner& value : message.corners()) corners.push_back(corner(value));
  return {{"header", header(message.header())},
          {"covariance_mode", message.covariance_mode()},
          {"corners", corners}};
}

}  // namespace quoin::topics
